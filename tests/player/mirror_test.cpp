// Reflections against closed-form geometry: a mirror at z = 0 before a wall at z = 3 with a red square on it.
#include "formats/query/camera.h"
#include "tests/player/frame_fixture.h"

namespace oriel {
namespace {
using namespace testing;

constexpr float kWall = 3;
const Vec3 kRed(40, 2, 2), kGrey(10, 10, 10);
// The square on the wall.
constexpr float kLeft = -0.2f, kRight = 0.6f, kBottom = -0.3f, kTop = 0.5f;

bool in_square(const Vec2& p) {
  return p.x > kLeft && p.x < kRight && p.y > kBottom && p.y < kTop;
}

Seen wall(const Vec2& on_plane, const Vec3& direction) {
  const Vec2 hit = on_plane + Vec2(direction) * (kWall / direction.z);
  return {in_square(hit) ? kRed : kGrey, kWall};
}

Pack mirror_pack(const std::function<Seen(const Vec2&, const Vec3&)>& seen = wall,
                 const std::vector<Vec3>& eyes = {
                     {0, 0, -1}, {0.5f, 0, -1}, {-0.5f, 0, -1}, {0, 0.5f, -1}, {0, -0.5f, -1}}) {
  Pack pack;
  pack.materials.resize(2);
  pack.materials[0].base_color = Vec3(1);
  pack.materials[0].metallic = 1;
  pack.materials[0].roughness = 0;
  pack.materials[0].fresnel_map = 0;
  pack.fresnel_maps.push_back(flat_reflectance({0.5f, 0.5f, 1.0f}));
  add_mirror(pack, eyes, 128, seen);
  return pack;
}

Camera camera_to_mirror(const Vec3& eye, const Vec3& target = Vec3(0)) {
  return look_at(eye, target, 1.4f);
}

// What a pixel of the mirror shows, and whether the answer is at least `margin` metres from the square's edge.
struct Expected {
  bool on_mirror = false, sure = false, red = false;
};
Expected expected_at(const Camera& camera, int x, int y, int width, int height, float margin) {
  const View view = make_view(camera, width, height, {});
  const Vec2 ndc((static_cast<float>(x) + 0.5f) / static_cast<float>(width) * 2 - 1,
                 1 - (static_cast<float>(y) + 0.5f) / static_cast<float>(height) * 2);
  const Vec3 direction = glm::transpose(Mat3(view.view_from_pack)) * Vec3(ndc * view.tangents, -1);
  Expected out;
  if (direction.z >= 0 || camera.eye.z <= 0) return out;
  const Vec2 on_plane = Vec2(camera.eye) + Vec2(direction) * (camera.eye.z / -direction.z);
  out.on_mirror = std::fabs(on_plane.x) < 0.99f && std::fabs(on_plane.y) < 0.99f;
  const Vec2 hit = on_plane + Vec2(direction) * (kWall / -direction.z);
  out.red = in_square(hit);
  out.sure = in_square(hit + Vec2(margin)) == out.red && in_square(hit - Vec2(margin)) == out.red &&
             in_square(hit + Vec2(margin, -margin)) == out.red && in_square(hit + Vec2(-margin, margin)) == out.red;
  return out;
}

class Mirror : public FrameTest {
 protected:
  static constexpr float kFiltered = 0.14f;  // light is filtered over two of a map's pixels
  // Every pixel of the mirror, at least `margin` metres from edges, shows the right thing times `factor`. Returns how
  // many pixels were red. A map's pixel covers 0.0625 m of the wall.
  int check(const Picture& p, const Camera& camera, const Vec3& factor, float margin = kFiltered) {
    int red = 0, wrong = 0, holes = 0;
    for (int y = 0; y < p.height; ++y) {
      for (int x = 0; x < p.width; ++x) {
        const Expected e = expected_at(camera, x, y, p.width, p.height, margin);
        if (!e.on_mirror) continue;
        const Vec3 found = p.at(x, y) / factor;
        holes += !(found.x > 1);
        if (!e.sure) continue;
        red += e.red;
        wrong += glm::length(found - (e.red ? kRed : kGrey)) > 1e-3f;
      }
    }
    EXPECT_EQ(wrong, 0);
    EXPECT_EQ(holes, 0);
    EXPECT_TRUE(p.finite());
    return red;
  }
};

TEST_F(Mirror, ShowsTheSquareWhereGeometrySays) {
  const Pack pack = mirror_pack();
  for (const Vec3& eye :
       {Vec3(0, 0, 1), Vec3(0.5f, 0.3f, 1.5f), Vec3(-0.8f, -0.4f, 0.7f), Vec3(0.01f, 0, 0.05f), Vec3(0, 0, 2.9f)}) {
    const Camera camera = camera_to_mirror(eye);
    const Picture p = draw(pack, camera, 160, 120);
    EXPECT_GT(check(p, camera, {0.5f, 0.5f, 1}), 40) << eye.x << " " << eye.y << " " << eye.z;
    EXPECT_EQ(p.stats.reflectors, 1u);
    EXPECT_EQ(p.stats.maps, 2u);
  }
}

TEST_F(Mirror, StagesAndReflectances) {
  const Camera camera = camera_to_mirror({0.2f, 0.1f, 1.2f});
  FrameOptions options;
  options.show = Show::kMKR;
  check(draw(mirror_pack(), camera, 80, 60, options), camera, {0.5f, 0.5f, 1});
  options.show = Show::kM;
  check(draw(mirror_pack(), camera, 80, 60, options), camera, Vec3(1));
  options.show = Show::kMK;
  check(draw(mirror_pack(), camera, 80, 60, options), camera, Vec3(1));
  options.show = Show::kD;
  const Picture d = draw(mirror_pack(), camera, 80, 60, options);
  EXPECT_EQ(glm::length(d.at(40, 30)), 0) << "a metal reflects nothing diffusely";
  EXPECT_EQ(d.stats.reflectors, 0u);
}

// The checker above must see a mirror that is wrong: maps whose depth says the wall is nearer than it is.
TEST_F(Mirror, WrongDepthIsSeen) {
  const Pack pack = mirror_pack([](const Vec2& p, const Vec3& d) { return Seen{wall(p, d).radiance, 1.5f}; });
  const Camera camera = camera_to_mirror({0.5f, 0.3f, 1.5f});
  const Picture p = draw(pack, camera, 160, 120);
  int wrong = 0;
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) {
      const Expected e = expected_at(camera, x, y, 160, 120, 0.08f);
      if (e.on_mirror && e.sure)
        wrong += glm::length(p.at(x, y) / Vec3(0.5f, 0.5f, 1) - (e.red ? kRed : kGrey)) > 1e-3f;
    }
  }
  EXPECT_GT(wrong, 30);
}

TEST_F(Mirror, TheSkyIsReflectedAtInfinity) {
  const Pack pack = mirror_pack([](const Vec2&, const Vec3& d) {
    return Seen{d.x > 0 ? kRed : kGrey, std::numeric_limits<float>::infinity()};
  });
  for (const float x : {-0.5f, 0.0f, 0.5f}) {
    const Camera camera = camera_to_mirror({x, 0, 2}, {x, 0, 0});
    const Picture p = draw(pack, camera, 81, 61);  // the sky's edge stays in the middle wherever the eye moves
    EXPECT_NEAR(p.at(36, 30).x, 0.5f * kGrey.x, 1e-3f);
    EXPECT_NEAR(p.at(44, 30).x, 0.5f * kRed.x, 1e-3f);
  }
}

// A post before the wall hides it from the maps; an eye elsewhere looks behind it. Holes are filled.
TEST_F(Mirror, DisocclusionsAreFilled) {
  const auto post = [](const Vec2& p, const Vec3& d) {
    const Vec2 at = p + Vec2(d) * (1.0f / d.z);
    return std::fabs(at.x) < 0.15f ? Seen{Vec3(20), 1.0f} : Seen{kGrey, kWall};
  };
  const Pack pack = mirror_pack(post, {{0, 0, -1}});
  const Picture p = draw(pack, camera_to_mirror({0.9f, 0, 1.4f}), 160, 120);
  int seen = 0;
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) {
      if (!expected_at(camera_to_mirror({0.9f, 0, 1.4f}), x, y, 160, 120, 0.01f).on_mirror) continue;
      ++seen;
      EXPECT_GE(p.at(x, y).x, 0.5f * kGrey.x * 0.99f) << x << "," << y;
      EXPECT_LE(p.at(x, y).x, 10.01f) << x << "," << y;
    }
  }
  EXPECT_GT(seen, 2000);
}

// A post before the wall hides it in the mirror too, however far beyond the scene's own bounds the mirrored things lie.
TEST_F(Mirror, NearThingsHideFarOnes) {
  const auto post = [](const Vec2& p, const Vec3& d) {
    return std::fabs(p.x + d.x / d.z) < 0.3f ? Seen{Vec3(20), 1.0f} : wall(p, d);
  };
  const Pack pack = mirror_pack(post);
  for (const Vec3& eye : {Vec3(0.2f, 0, 1), Vec3(-0.5f, 0.3f, 1.2f)}) {
    const Camera camera = camera_to_mirror(eye);
    FrameOptions options;
    options.show = Show::kM;
    options.maps_per_element = 5;
    const Picture p = draw(pack, camera, 160, 120, options);
    const View view = make_view(camera, 160, 120, {});
    int seen = 0;
    for (int y = 0; y < 120; ++y) {
      for (int x = 0; x < 160; ++x) {
        if (!expected_at(camera, x, y, 160, 120, 0).on_mirror) continue;
        const Vec2 ndc((static_cast<float>(x) + 0.5f) / 80 - 1, 1 - (static_cast<float>(y) + 0.5f) / 60);
        const Vec3 direction = glm::transpose(Mat3(view.view_from_pack)) * Vec3(ndc * view.tangents, -1);
        const float at = eye.x + direction.x * ((eye.z + 1) / -direction.z);
        const float up = eye.y + direction.y * ((eye.z + 1) / -direction.z);
        if (std::fabs(at) > 0.25f || std::fabs(up) > 1.8f) continue;  // lower, not all maps see it
        ++seen;
        EXPECT_NEAR(p.at(x, y).y, 20, 1e-3f) << x << "," << y;
      }
    }
    EXPECT_GT(seen, 1000);
  }
}

// No map saw anything through part of it: the mirror shows what its maps hold elsewhere, not black.
TEST_F(Mirror, InvalidPixelsLeaveNoHoles) {
  Pack pack = mirror_pack([](const Vec2&, const Vec3&) { return Seen{kGrey, kWall}; });
  for (RadianceMap& map : pack.radiance_maps) {
    for (std::size_t i = 0; i < map.valid.size(); ++i) {
      if (i % map.width > 20) map.valid[i] = 0;
    }
  }
  const Camera camera = camera_to_mirror({0, 0, 1});
  const Picture p = draw(pack, camera, 80, 60);
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) {
      if (!expected_at(camera, x, y, 80, 60, 0).on_mirror) continue;
      ASSERT_NEAR(p.at(x, y).x, 0.5f * kGrey.x, 1e-3f) << x << "," << y;
    }
  }
  for (RadianceMap& map : pack.radiance_maps) map.valid.assign(map.valid.size(), 0);
  EXPECT_EQ(glm::length(draw(pack, camera, 80, 60).at(40, 30)), 0);
}

BrdfKernel box_kernel(std::uint32_t size, float half_extent) {
  BrdfKernel kernel;
  kernel.alpha = 0.1f;
  kernel.size = size;
  kernel.half_extent = half_extent;
  kernel.weights.assign(std::size_t{size} * size, 1.0f / static_cast<float>(size * size));
  return kernel;
}

TEST_F(Mirror, AKernelKeepsAFlatImageAndBlursAnEdgeByItsDistance) {
  Pack pack = mirror_pack([](const Vec2&, const Vec3&) { return Seen{kGrey, kWall}; });
  pack.kernels.push_back(box_kernel(9, 0.3f));
  pack.materials[0].kernel = 0;
  const Camera camera = camera_to_mirror({0.2f, 0.1f, 1.2f});
  const Picture flat = draw(pack, camera, 160, 120);
  EXPECT_NEAR(flat.at(80, 60).x, 0.5f * kGrey.x, 1e-3f);
  EXPECT_NEAR(flat.at(80, 60).z, kGrey.z, 1e-3f);

  // An edge at x = 0 of the wall, seen from straight before: between the levels over +-0.3 * d / (d + e) of the
  // tangent.
  const auto edge = [](const Vec2& p, const Vec3& d) {
    return Seen{p.x + d.x * (kWall / d.z) > 0 ? kRed : kGrey, kWall};
  };
  Pack blurred = mirror_pack(edge);
  blurred.kernels = pack.kernels;
  blurred.materials[0].kernel = 0;
  const float eye = 1;
  const Camera straight = camera_to_mirror({0, 0, eye});
  const int width = 480, height = 360;
  const Picture p = draw(blurred, straight, width, height);
  const float pixels = 0.5f * height / std::tan(0.5f * straight.vertical_fov_rad) * 0.3f * kWall / (kWall + eye);
  const auto share = [&](float offset) {
    const float v = p.at(static_cast<int>(width / 2 + offset), height / 2).x / 0.5f;
    return (v - kGrey.x) / (kRed.x - kGrey.x);
  };
  EXPECT_NEAR(share(0), 0.5f, 0.08f);
  EXPECT_NEAR(share(0.5f * pixels), 0.75f, 0.08f);
  EXPECT_NEAR(share(-0.5f * pixels), 0.25f, 0.08f);
  EXPECT_NEAR(share(1.3f * pixels), 1.0f, 0.02f);
  EXPECT_NEAR(share(-1.3f * pixels), 0.0f, 0.02f);
}

TEST_F(Mirror, EdgeOnOnThePlaneAndBehind) {
  const Pack pack = mirror_pack();
  for (const Vec3& eye : {Vec3(3, 0, 0), Vec3(3, 0, 1e-7f), Vec3(3, 0, 1e-3f), Vec3(0, 0, 0), Vec3(0.3f, 0, -1),
                          Vec3(0, 0, 1e-6f), Vec3(500, 0, 0.01f)}) {
    for (const Vec3& target : {Vec3(0.01f, 0, 0), Vec3(0, 0.4f, -2)}) {
      const Picture p = draw(pack, camera_to_mirror(eye, target), 64, 48);
      EXPECT_TRUE(p.finite()) << eye.x << " " << eye.z;
    }
  }
  FrameOptions options;
  options.show = Show::kM;
  EXPECT_EQ(draw(pack, camera_to_mirror({0, 0, -1}), 64, 48, options).stats.reflectors, 0u)
      << "behind it there is no mirror";
}

TEST_F(Mirror, HiddenMirrorsCostNothing) {
  Pack pack = mirror_pack();
  pack.lightmaps.push_back(flat_page(Vec3(100)));
  add_quad(pack, {-2, -2, 0.5f}, {4, 0, 0}, {0, 4, 0}, 1, 0);  // a board before the mirror
  const Picture p = draw(pack, camera_to_mirror({0, 0, 2}), 64, 48);
  EXPECT_EQ(p.stats.reflectors, 0u);
  EXPECT_NEAR(p.at(32, 24).x, 100 / kPi, 0.02f);
}

// A window pane that mirrors: what is behind it shows through, and the reflection is added.
TEST_F(Mirror, SeeThroughReflectorsAdd) {
  Pack pack = mirror_pack([](const Vec2&, const Vec3&) { return Seen{kGrey, kWall}; });
  pack.materials[0].metallic = 0;
  pack.materials[0].transmission = 1;
  pack.sky = {64, 64, 64};
  const Picture p = draw(pack, camera_to_mirror({0, 0, 1}), 64, 48);
  // max R = 1: nothing passes; then a quarter.
  EXPECT_NEAR(p.at(32, 24).x, 0.5f * kGrey.x, 1e-2f);
  pack.fresnel_maps[0] = flat_reflectance(Vec3(0.25f));
  EXPECT_NEAR(draw(pack, camera_to_mirror({0, 0, 1}), 64, 48).at(32, 24).x, 0.25f * kGrey.x + 0.75f * 64, 1e-2f);
}

TEST_F(Mirror, WithNoMapChosenItShowsUndirectedLight) {
  Pack pack = mirror_pack();
  pack.lightmaps.push_back(flat_page(Vec3(256)));
  pack.mesh.parts[0].lightmap_page = 0;
  FrameOptions none;
  none.maps_per_element = 0;
  EXPECT_NEAR(draw(pack, camera_to_mirror({0, 0, 1}), 64, 48, none).at(32, 24).x, 128 / kPi, 1e-3f);
}

TEST_F(Mirror, OnePixelAnd4096) {
  const Pack pack = mirror_pack();
  const Camera camera = camera_to_mirror({0, 0, 1});
  EXPECT_TRUE(draw(pack, camera, 1, 1).finite());
  const Picture wide = draw(pack, camera, 4096, 4);
  EXPECT_TRUE(wide.finite());
  EXPECT_EQ(wide.stats.reflectors, 1u);
}

TEST_F(Mirror, SameFrameTwice) {
  const Pack pack = mirror_pack();
  const Camera camera = camera_to_mirror({0.4f, 0.1f, 1.3f});
  EXPECT_EQ(draw(pack, camera, 100, 70).rgb, draw(pack, camera, 100, 70).rgb);
}

TEST_F(Mirror, Orthographic) {
  const Pack pack = mirror_pack();
  Camera camera = camera_to_mirror({0, 0, 2});
  camera.vertical_fov_rad = 0;
  camera.half_height = 1;
  const Picture p = draw(pack, camera, 100, 100);
  ASSERT_TRUE(p.finite());
  // Straight rays: pixel (x, y) shows the wall at its own place.
  for (int y = 4; y < 96; ++y) {
    for (int x = 4; x < 96; ++x) {
      const Vec2 at((static_cast<float>(x) + 0.5f) / 50 - 1, 1 - (static_cast<float>(y) + 0.5f) / 50);
      const bool red = in_square(at);
      if (in_square(at + Vec2(0.08f)) != red || in_square(at - Vec2(0.08f)) != red ||
          in_square(at + Vec2(0.08f, -0.08f)) != red || in_square(at + Vec2(-0.08f, 0.08f)) != red)
        continue;
      ASSERT_NEAR(p.at(x, y).x, 0.5f * (red ? kRed.x : kGrey.x), 1e-3f) << x << "," << y;
    }
  }
}

}  // namespace
}  // namespace oriel
