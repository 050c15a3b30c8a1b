// M as coarse as its blur allows: where it may be, and where it must not; and M beyond a reflector's edges, which blur
// alone looks at.
#include "formats/query/camera.h"
#include "tests/player/frame_fixture.h"

namespace oriel {
namespace {
using namespace testing;

const Vec3 kRed(50, 0, 0), kGreen(0, 50, 0);

// The mirror of add_mirror with a lobe even over a square: half of it within 0.8 of that tangent.
Pack blurring_pack(float half_extent, const std::vector<Vec3>& eyes,
                   const std::function<Seen(const Vec2&, const Vec3&)>& seen, std::uint32_t size = 256) {
  Pack pack;
  pack.materials.resize(1);
  pack.materials[0].metallic = 1;
  pack.materials[0].kernel = 0;
  pack.materials[0].fresnel_map = 0;
  pack.fresnel_maps.push_back(flat_reflectance(Vec3(1)));
  BrdfKernel kernel;
  kernel.alpha = 0.1f;
  kernel.size = 9;
  kernel.half_extent = half_extent;
  kernel.weights.assign(81, 1.0f / 81);
  pack.kernels.push_back(kernel);
  add_mirror(pack, eyes, size, seen);
  return pack;
}

Camera camera_at(const Vec3& eye, const Vec3& target) {
  return look_at(eye, target, 1.2f);
}

constexpr int kBlurredWidth = 480, kBlurredHeight = 360;

// Without maps; materials 1 and 2 are red and blue lamps.
Pack pack_with_lamps() {
  Pack pack = blurring_pack(0.3f, {}, nullptr);
  pack.materials.resize(3);
  pack.materials[1].emission = kRed;
  pack.materials[2].emission = {0, 0, 50};
  return pack;
}

class Blurred : public FrameTest {
 protected:
  Picture draw_mk(const Pack& pack, const Camera& camera) {
    FrameOptions options;
    options.show = Show::kMK;
    return draw(pack, camera, kBlurredWidth, kBlurredHeight, options);
  }
  // In the reflector's last pixels of each row.
  static void expect_red_feet(const Picture& p) {
    int feet = 0;
    for (int y = kBlurredHeight / 2 - 40; y <= kBlurredHeight / 2 + 40; y += 8) {
      int x = kBlurredWidth - 1;
      while (x > 0 && p.at(x, y) == Vec3(0)) --x;
      for (int i = 0; i < 4; ++i, ++feet) EXPECT_LT(p.at(x - i, y).y, 0.05f * kGreen.y) << x - i << "," << y;
    }
    EXPECT_GT(feet, 20);
  }
};

// Stripes at three distances above one another, red to the right of the middle: each edge is as wide as its distance
// blurs it. The nearest, next to the plane, is sharp between rows whose M is coarse.
TEST_F(Blurred, WhatIsNearStaysSharpBesideWhatIsFar) {
  const auto band = [](float y) { return std::fabs(y) < 0.2f ? 0.01f : 3.0f; };
  const Pack pack = blurring_pack(0.3f, {{0, 0, -1}}, [&](const Vec2& p, const Vec3& d) {
    const float near = band(p.y + 0.01f * d.y / d.z), z = near;
    return Seen{p.x + d.x * (z / d.z) > 0 ? kRed : kGreen, z};
  });
  const Picture p = draw_mk(pack, camera_at({0, 0, 1}, {0, 0, 0}));
  const auto share = [&](int x, int y) { return p.at(kBlurredWidth / 2 + x, kBlurredHeight / 2 + y).x / kRed.x; };
  const float pixels = 0.5f * kBlurredHeight / std::tan(0.6f);  // a tangent
  for (const int y : {-20, 0, 20}) {                            // the near band's half is 0.2 * pixels = 52
    EXPECT_GT(share(4, y), 0.97f) << y;
    EXPECT_LT(share(-5, y), 0.03f) << y;
  }
  const int far = static_cast<int>(0.5f * pixels), half = static_cast<int>(0.5f * 0.3f * 0.75f * pixels);
  for (const int y : {-far, far}) {
    EXPECT_NEAR(share(half, y), 0.75f, 0.08f);
    EXPECT_NEAR(share(-half, y), 0.25f, 0.08f);
  }
}

// What lies behind a board in the image blurs into what is seen beside it, the same as without the board.
TEST_F(Blurred, WhatIsHiddenBlursIntoWhatIsSeen) {
  Pack pack = blurring_pack(0.3f, {{0, 0, -1}}, [](const Vec2& p, const Vec3& d) {
    const Vec2 at = p + Vec2(d) * (3 / d.z);
    return Seen{Vec3(20 + 15 * std::sin(6 * at.x), 20 + 15 * std::sin(6 * at.y), 1), 3};
  });
  const Camera camera = camera_at({0, 0, 1}, {0, 0, 0});
  const Picture open = draw_mk(pack, camera);
  pack.materials.resize(2);
  add_quad(pack, {-0.4f, -0.5f, 0.1f}, {0.5f, 0, 0}, {0, 1, 0}, 1, -1);
  const Picture behind = draw_mk(pack, camera);
  int seen = 0, hidden = 0;
  float worst = 0;
  for (int y = 0; y < kBlurredHeight; ++y)
    for (int x = 0; x < kBlurredWidth; ++x) {
      if (open.at(x, y) == Vec3(0)) continue;
      if (behind.at(x, y) == Vec3(0)) {
        ++hidden;
        continue;
      }
      ++seen;
      worst = std::max(worst, glm::length(behind.at(x, y) - open.at(x, y)));
    }
  EXPECT_GT(seen, 20000);
  EXPECT_GT(hidden, 5000);
  EXPECT_LT(worst, 0.5f) << "of 5 to 35";
}

// A low red wall stands on the reflector's right edge, before a green one far away. What maps show past the edge is
// behind that wall, and no green shines into its foot.
TEST_F(Blurred, BesideAWallAtItsEdgeMapsShowNothingOfWhatLiesBehind) {
  Pack pack = blurring_pack(0.3f, {{-3, 0, -1}}, [](const Vec2& p, const Vec3& d) {
    const float z = (1 - p.x) / d.x * d.z;
    return d.x > 0 && z < 0.3f ? Seen{kRed, z} : Seen{kGreen, 3};
  });
  pack.materials.resize(2);
  add_quad(pack, {1, -1, 0}, {0, 0, 0.3f}, {0, 2, 0}, 1, -1);
  const Picture p = draw_mk(pack, camera_at({-0.9f, 0, 1}, {0.8f, 0, 0}));
  expect_red_feet(p);
}

// The same of mirrored geometry: a blue wall close behind the red one is seen by no ray from the reflector, but in its
// image past the red one's foot.
TEST_F(Blurred, BesideAWallAtItsEdgeAReflectorShowsNothingOfWhatLiesBehind) {
  Pack pack = pack_with_lamps();
  add_quad(pack, {1, -1, 0}, {0, 0, 1.5f}, {0, 2, 0}, 1, -1);
  add_quad(pack, {1.02f, -1, 0}, {0, 0, 1.5f}, {0, 2, 0}, 2, -1);
  Camera camera = camera_at({-0.9f, 0, 1}, {0.8f, 0, 0});
  camera.up = {0.3f, 1, 0};  // its edge is no edge of the image
  const Picture p = draw_mk(pack, camera);
  float red = 0, blue = 0;
  for (int y = 0; y < kBlurredHeight; ++y)
    for (int x = 0; x < kBlurredWidth; ++x) red = std::max(red, p.at(x, y).x), blue = std::max(blue, p.at(x, y).z);
  EXPECT_GT(red, 0.9f * kRed.x);
  EXPECT_LT(blue, 0.01f * kRed.x);
}

// And a bright sky, which the reflector shows elsewhere, does not flow in along the wall's foot because it is far away.
TEST_F(Blurred, BesideAWallAtItsEdgeAReflectorShowsNothingOfTheSky) {
  Pack pack = pack_with_lamps();
  pack.sky = kGreen;
  add_quad(pack, {1, -1, 0}, {0, 0, 0.3f}, {0, 2, 0}, 1, -1);
  const Picture p = draw_mk(pack, camera_at({-0.9f, 0, 1}, {0.8f, 0, 0}));
  expect_red_feet(p);
  float green = 0;
  for (int x = 0; x < kBlurredWidth; ++x) green = std::max(green, p.at(x, kBlurredHeight / 2).y);
  EXPECT_GT(green, 0.9f * kGreen.y);
}

// Past a free edge its lobes see what there is: half of a table's top shows what the whole one does, up to its edge.
TEST_F(Blurred, AFreeEdgeChangesNothing) {
  Pack pack = pack_with_lamps();
  add_quad(pack, {3, -2, 0.1f}, {0, 0, 4}, {0, 2, 0}, 1, -1);
  add_quad(pack, {3, 0, 0.1f}, {0, 0, 4}, {0, 2, 0}, 2, -1);
  Camera camera = camera_at({-1.5f, 0, 0.4f}, {0, 0, 0});
  camera.up = {0, 0, 1};
  const Picture whole = draw_mk(pack, camera);
  Reflector& half = pack.reflectors[0];
  half.upper.x = -0.2f;
  for (Vec3& p : pack.mesh.positions)
    if (p.z == 0) p.x = std::min(p.x, -0.2f);
  const Picture part = draw_mk(pack, camera);
  int seen = 0, off = 0;
  for (int y = 0; y < kBlurredHeight; ++y)
    for (int x = 0; x < kBlurredWidth; ++x) {
      if (part.at(x, y) == Vec3(0)) continue;
      ++seen;
      off += glm::length(part.at(x, y) - whole.at(x, y)) > 0.02f * kRed.x;
    }
  EXPECT_GT(seen, 2000);
  EXPECT_LT(off, seen / 50);
}

}  // namespace
}  // namespace oriel
