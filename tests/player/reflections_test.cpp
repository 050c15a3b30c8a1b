// What reflectors show besides their maps: mirrored geometry and emitters in closed form; and what is left at the
// extremes.
#include "formats/query/camera.h"
#include "formats/query/lobe_light.h"
#include "player/passes/mirrored_view.h"
#include "tests/player/frame_fixture.h"
#include "tests/player/twins/reflected_polygon.h"

namespace oriel {
namespace {
using namespace testing;

const Vec3 kReflectedGrey(10, 10, 10);

Camera camera_before(const Vec3& eye, const Vec3& target = Vec3(0)) {
  return look_at(eye, target, 1.2f);
}

// The mirror of add_mirror, all of it kGrey at z = 3, and materials 1 … 3 that shine red, green, blue.
Pack pack_of_mirror() {
  Pack pack;
  pack.materials.resize(4);
  pack.materials[0].metallic = 1;
  pack.materials[0].roughness = 0;
  pack.materials[0].fresnel_map = 0;
  pack.fresnel_maps.push_back(flat_reflectance(Vec3(0.5f)));
  pack.materials[1].emission = {8, 0, 0};
  pack.materials[2].emission = {0, 8, 0};
  pack.materials[3].emission = {0, 0, 8};
  add_mirror(pack, {{0, 0, -1}}, 16, [](const Vec2&, const Vec3&) { return Seen{kReflectedGrey, 3}; });
  return pack;
}

// Maps that are black, a lobe that is a cosine, and a square lamp over the mirror's middle that they leave out.
Pack lamp_pack() {
  Pack pack = pack_of_mirror();
  BrdfKernel kernel;
  kernel.alpha = 1;
  kernel.size = kernel.slice_size = 1;
  kernel.weights = {1};
  KernelSlice slice;
  slice.width = Vec2(1);
  slice.weights = {1};
  kernel.slices.assign(2, slice);
  kernel.slices[0].cos_theta = 0.1f;
  kernel.fits.resize(2);  // the identity: a clamped cosine
  pack.kernels.push_back(kernel);
  pack.materials[0].kernel = 0;
  for (RadianceMap& map : pack.radiance_maps) map.radiance.assign(map.radiance.size(), Vec3(0));
  Emitter emitter;
  emitter.corners = {{-1, -1, 2}, {-1, 1, 2}, {1, 1, 2}, {1, -1, 2}};  // bright towards -z
  emitter.radiance = {100, 50, 25};
  pack.emitters.push_back(emitter);
  Reflector& reflector = pack.reflectors[0];
  reflector.emitters = {0};
  reflector.visibility_x = reflector.visibility_y = 2;
  reflector.visibility.assign(4, 255);
  return pack;
}

class Reflected : public FrameTest {};

// Red at the left and green at the right of the eye, behind it; blue behind the mirror, where it must be clipped.
TEST_F(Reflected, GeometryIsMirroredAndClippedAtThePlane) {
  Pack pack = pack_of_mirror();
  add_quad(pack, {0, -4, 4}, {-8, 0, 0}, {0, 8, 0}, 1, -1);
  add_quad(pack, {8, -4, 4}, {-8, 0, 0}, {0, 8, 0}, 2, -1);
  add_quad(pack, {2, -2, -0.5f}, {-4, 0, 0}, {0, 4, 0}, 3, -1);
  FrameOptions options;
  options.reflections = Reflections::kGeometry;
  options.show = Show::kM;
  const Picture p = draw(pack, camera_before({0, 0, 2}), 64, 48, options);
  EXPECT_NEAR(glm::length(p.at(24, 24) - Vec3(8, 0, 0)), 0, 1e-4f);
  EXPECT_NEAR(glm::length(p.at(40, 24) - Vec3(0, 8, 0)), 0, 1e-4f);
  EXPECT_TRUE(p.finite());
}

// Of two lamps of one material the one that the maps leave out is dark, and a pane before the other dims it.
TEST_F(Reflected, GeometryLeavesOutTheListedEmittersAndShowsPanes) {
  Pack pack = lamp_pack();
  pack.emitters[0].corners = {{0, -4, 4}, {-8, -4, 4}, {-8, 4, 4}, {0, 4, 4}};
  add_quad(pack, {0, -4, 4}, {-8, 0, 0}, {0, 8, 0}, 1, -1);
  add_quad(pack, {8, -4, 4}, {-8, 0, 0}, {0, 8, 0}, 1, -1);
  pack.materials.resize(5);
  pack.materials[4].alpha_mode = AlphaMode::kBlend;
  pack.materials[4].alpha = 0.25f;
  pack.materials[4].double_sided = true;
  pack.materials[4].emission = {0, 4, 0};
  add_quad(pack, {8, 0, 3}, {-8, 0, 0}, {0, 4, 0}, 4, -1);
  FrameOptions options;
  options.reflections = Reflections::kGeometry;
  options.show = Show::kM;
  const Picture p = draw(pack, camera_before({0, 0, 2}), 64, 48, options);
  EXPECT_NEAR(glm::length(p.at(24, 32)), 0, 1e-4f);
  EXPECT_NEAR(glm::length(p.at(40, 32) - Vec3(8, 0, 0)), 0, 1e-4f);
  EXPECT_NEAR(glm::length(p.at(40, 16) - Vec3(6, 1, 0)), 0, 1e-4f);
}

TEST(NearPlane, CutsThereAndKeepsTheRest) {
  const View view = make_view(camera_before({0, 0, 0}, {0, 0, -1}), 64, 48, {{-9, -9, -9}, {9, 9, 9}});
  const Vec4 plane = glm::normalize(Vec4(0.3f, 0.1f, -1, -2));
  const Mat4 cut = with_near_plane(view.clip_from_pack, plane);
  for (const Vec3& p : {Vec3(0, 0, -2.5f), Vec3(0.5f, 0, -1.9f), Vec3(0, 0.4f, -2.1f), Vec3(-0.3f, 0.2f, -6)}) {
    const Vec4 before = view.clip_from_pack * Vec4(p, 1), after = cut * Vec4(p, 1);
    EXPECT_NEAR(before.x / before.w, after.x / after.w, 1e-5f);
    EXPECT_NEAR(before.y / before.w, after.y / after.w, 1e-5f);
    EXPECT_EQ(after.z >= -after.w, glm::dot(plane, Vec4(p, 1)) >= 0) << p.x << " " << p.y << " " << p.z;
    EXPECT_LE(after.z, after.w * 1.0001f);
  }
}

// Of a mirror behind a wall only what the wall leaves open costs anything, and it looks the same.
TEST_F(Reflected, OnlyWhatIsVisibleIsReflected) {
  Pack pack = pack_of_mirror();
  pack.radiance_maps.clear();
  pack.reflectors.clear();
  add_mirror(pack, {{0, 0, -1}}, 64, [](const Vec2& at, const Vec3&) {
    return Seen{Vec3(5.0f + at.x, 5.0f + at.y, 1), 3};
  });
  FrameOptions options;
  options.show = Show::kMKR;
  const Camera camera = camera_before({0, 0, 2});
  const Picture open = draw(pack, camera, 128, 96, options);
  add_quad(pack, {-2, -2, 0.5f}, {2.6f, 0, 0}, {0, 4, 0}, 3, -1);  // leaves less than the right quarter
  const Picture behind = draw(pack, camera, 128, 96, options);
  EXPECT_LT(2 * behind.stats.image_pixels, open.stats.image_pixels);
  int seen = 0;
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 128; ++x)
      if (behind.at(x, y) != Vec3(0)) {
        ++seen;
        EXPECT_NEAR(glm::length(behind.at(x, y) - open.at(x, y)), 0, 1e-5f) << x << "," << y;
      }
  EXPECT_GT(seen, 200);
  add_quad(pack, {-2, -2, 0.4f}, {4, 0, 0}, {0, 4, 0}, 3, -1);
  const Picture hidden = draw(pack, camera, 128, 96, options);
  EXPECT_EQ(hidden.stats.image_pixels, 0u);
  EXPECT_EQ(hidden.stats.reflectors, 0u);
}

// The lobe shows a parallel square as its form factor from a point under its centre (Nusselt).
TEST_F(Reflected, EmittersInACosineLobeAreFormFactors) {
  Pack pack = lamp_pack();
  Reflector& reflector = pack.reflectors[0];
  // Of a square of half side a at height h, over its centre: (2/π) · 2 · x/√(1+x²) atan(x/√(1+x²)), x = a / h.
  const float x = 0.5f / std::sqrt(1.25f);
  const float expected = 4 / kPi * x * std::atan(x);
  const Camera camera = camera_before({0, 0, 1});
  FrameOptions options;
  options.show = Show::kMK;
  const auto middle = [&] { return draw(pack, camera, 65, 49, options).at(32, 24); };
  EXPECT_NEAR(middle().x, 100 * expected, 0.05f);
  EXPECT_NEAR(middle().z, 25 * expected, 0.02f);
  reflector.visibility.assign(4, 51);
  EXPECT_NEAR(middle().x, 20 * expected, 0.02f);
  std::swap(pack.emitters[0].corners[1], pack.emitters[0].corners[3]);  // its dark side
  EXPECT_EQ(middle().x, 0);
  pack.emitters[0].two_sided = true;
  EXPECT_NEAR(middle().x, 20 * expected, 0.02f);
  options.show = Show::kM;
  EXPECT_EQ(middle().x, 0) << "M is the world without them";
}

// As many lamps as a reflector may list shine like the one that they are pieces of.
TEST_F(Reflected, EmittersShineToTheLastThatIsListed) {
  Pack pack = lamp_pack();
  const Camera camera = camera_before({0.3f, 0.1f, 1});
  FrameOptions options;
  options.show = Show::kMK;
  const Picture one = draw(pack, camera, 65, 49, options);
  const Emitter lamp = pack.emitters[0];
  const Vec3 across = lamp.corners[1] - lamp.corners[0], along = lamp.corners[3] - lamp.corners[0];
  Reflector& reflector = pack.reflectors[0];
  reflector.emitters.clear(), pack.emitters.clear();
  constexpr int kSide = 8;
  static_assert(kSide * kSide == kMaxReflectorEmitters);
  for (int i = 0; i < kSide * kSide; ++i) {
    Emitter piece = lamp;
    for (int c = 0; c < 4; ++c)
      piece.corners[static_cast<std::size_t>(c)] =
          lamp.corners[0] + (across * static_cast<float>(i % kSide + (c == 1 || c == 2)) +
                             along * static_cast<float>(i / kSide + (c >= 2))) /
                                static_cast<float>(kSide);
    reflector.emitters.push_back(static_cast<std::uint32_t>(i));
    pack.emitters.push_back(piece);
  }
  reflector.visibility.assign(4 * kMaxReflectorEmitters, 255);
  const Picture pieces = draw(pack, camera, 65, 49, options);
  EXPECT_GT(one.at(32, 24).x, 1);
  for (int y = 0; y < 49; y += 4)
    for (int x = 0; x < 65; x += 4) EXPECT_NEAR(pieces.at(x, y).x, one.at(x, y).x, 0.02f) << x << ", " << y;
}

// What the plane cuts off a lamp lights nothing: of a quad it may leave five corners. Seen along the normal, the lobe
// is a cosine.
TEST_F(Reflected, EmittersThroughThePlaneAreCutThere) {
  Pack pack = lamp_pack();
  pack.emitters[0].two_sided = true;
  FrameOptions options;
  options.show = Show::kMK;
  const std::vector<std::vector<Vec3>> emitters = {
      {{1, -1, -1}, {1, 1, -1}, {1, 1, 1}, {1, -1, 1}},               // two corners behind it
      {{1, 0, -0.5f}, {1, 1, 0.5f}, {1, 0, 1.5f}, {1, -1, 0.5f}},     // one
      {{1, 0, 0.5f}, {1, 1, -0.5f}, {1, 0, -1.5f}, {1, -1, -0.5f}},   // three
      {{1, 0, -0.5f}, {1, 1, 0.5f}, {1, -1, 0.5f}},                   // a triangle's one
      {{1, 0, -0.5f}, {1, 1, -0.5f}, {1, 1, -1.5f}, {1, 0, -1.5f}}};  // all
  for (const std::vector<Vec3>& corners : emitters) {
    pack.emitters[0].corners = corners;
    const Vec3 found = draw(pack, camera_before({0, 0, 1}), 65, 49, options).at(32, 24);
    EXPECT_NEAR(found.x, 100 * std::fabs(reflected_polygon(LobeFit{}, corners)), 0.02f) << corners.size();
  }
}

// Two lamps, each with its own shares at 4 by 3 nodes, of which most see nothing: every pixel shows them times what is
// linear between the nodes around it.
TEST_F(Reflected, EmittersAreSeenByTheNodesAroundAPixel) {
  Pack pack = lamp_pack();
  pack.emitters.push_back(pack.emitters[0]);
  pack.emitters[1].radiance = {0, 0, 80};
  pack.emitters[0].radiance = {100, 0, 0};
  Reflector& reflector = pack.reflectors[0];
  reflector.emitters = {0, 1};
  reflector.visibility_x = 4;
  reflector.visibility_y = 3;
  reflector.visibility.assign(24, 255);
  FrameOptions options;
  options.show = Show::kMK;
  const Camera camera = camera_before({0.2f, 0.1f, 1.5f}, {0.2f, 0.1f, 0});
  const Picture all = draw(pack, camera, 65, 49, options);
  reflector.visibility = {0, 0, 0,   0, 255, 0, 0,  0, 0, 0, 0, 0,     // the first lamp
                          0, 0, 102, 0, 0,   0, 51, 0, 0, 0, 0, 255};  // the second
  const Picture some = draw(pack, camera, 65, 49, options);
  const View view = make_view(camera, 65, 49, {});
  int partly = 0, dark = 0;
  for (int y = 0; y < 49; ++y)
    for (int x = 0; x < 65; ++x) {
      const Vec2 ndc((static_cast<float>(x) + 0.5f) / 32.5f - 1, 1 - (static_cast<float>(y) + 0.5f) / 24.5f);
      const Vec2 at = Vec2(camera.eye) + ndc * view.tangents * camera.eye.z;
      if (std::max(std::fabs(at.x), std::fabs(at.y)) > 0.98f) continue;
      const Vec2 cell = (at + 1.0f) * 0.5f * Vec2(3, 2);
      for (int lamp = 0; lamp < 2; ++lamp) {
        float share = 0;
        for (int n = 0; n < 12; ++n) {
          const Vec2 off = glm::abs(cell - Vec2(static_cast<float>(n % 4), static_cast<float>(n / 4)));
          share += reflector.visibility[static_cast<std::size_t>(12 * lamp + n)] / 255.0f * std::max(1 - off.x, 0.0f) *
                   std::max(1 - off.y, 0.0f);
        }
        const float found = some.at(x, y)[2 * lamp], whole = all.at(x, y)[2 * lamp];
        EXPECT_NEAR(found, share * whole, 1e-4f * whole + 1e-4f) << x << "," << y << " lamp " << lamp;
        dark += share == 0 && found == 0;
        partly += share > 0.1f && share < 0.9f;
      }
    }
  EXPECT_GT(dark, 500);
  EXPECT_GT(partly, 300);
}

// A point's square in a mirror may be far smaller than a pixel: wherever it lies, the frame has all of its light.
TEST_F(Reflected, GlintsHaveTheirLightBetweenPixelsToo) {
  Pack pack = lamp_pack();
  pack.materials[0].kernel = -1;
  pack.kernels.clear();
  constexpr float kSide = 0.01f, kRadiance = 1e4f;
  pack.emitters[0].radiance = Vec3(kRadiance);
  FrameOptions options;
  options.show = Show::kMK;
  const Camera camera = camera_before({0.3f, 0, 1});
  const View view = make_view(camera, 65, 49, {});
  int most = 0;
  float mean = 0;
  for (int i = 0; i < 12; ++i) {
    const Vec3 at(0.01f * static_cast<float>(i), 0.007f * static_cast<float>(i), 2);
    const Vec3 x(kSide, 0, 0), y(0, kSide, 0);
    pack.emitters[0].corners = {at, at + y, at + x + y, at + x};
    const Picture p = draw(pack, camera, 65, 49, options);
    float sum = 0;
    int lit = 0;
    for (int row = 0; row < 49; ++row)
      for (int column = 0; column < 65; ++column) {
        const Vec2 ndc((static_cast<float>(column) + 0.5f) / 32.5f - 1, 1 - (static_cast<float>(row) + 0.5f) / 24.5f);
        const Vec2 on_screen = ndc * view.tangents;
        const float pixel = 4 * view.tangents.x * view.tangents.y / (65 * 49);
        const float light = p.at(column, row).x;
        sum += light * pixel / std::pow(1 + glm::dot(on_screen, on_screen), 1.5f);
        lit += light > 0;
      }
    const Vec3 way = at + 0.5f * (x + y) - Vec3(camera.eye.x, camera.eye.y, -camera.eye.z);
    const float expected = kRadiance * kSide * kSide * way.z / std::pow(glm::length(way), 3.0f);
    EXPECT_NEAR(sum / expected, 1, 0.15f) << i << ": squares of two pixels are not quite side by side";
    mean += sum / expected / 12;
    EXPECT_GE(lit, 1) << i;
    most = std::max(most, lit);
  }
  EXPECT_NEAR(mean, 1, 0.03f);
  EXPECT_LE(most, 6) << "and no more than around it";
}

// Without blur a lamp is where the mirror ray meets it, as bright as it is.
TEST_F(Reflected, EmittersAreSharpWithoutBlur) {
  Pack pack = lamp_pack();
  FrameOptions options;
  options.show = Show::kMK;
  options.blur = Blur::kOff;
  const Camera camera = camera_before({0.3f, 0, 1});
  const View view = make_view(camera, 65, 49, {});
  const auto check = [&](float bright) {
    const Picture p = draw(pack, camera, 65, 49, options);
    int lit = 0;
    for (int y = 0; y < 49; ++y)
      for (int x = 0; x < 65; ++x) {
        const Vec2 ndc((static_cast<float>(x) + 0.5f) / 32.5f - 1, 1 - (static_cast<float>(y) + 0.5f) / 24.5f);
        const Vec3 direction = glm::transpose(Mat3(view.view_from_pack)) * Vec3(ndc * view.tangents, -1);
        const Vec2 on_plane = Vec2(camera.eye) + Vec2(direction) / -direction.z;
        if (std::max(std::fabs(on_plane.x), std::fabs(on_plane.y)) > 0.98f) continue;
        const Vec2 hit = on_plane + Vec2(direction) * (2 / -direction.z);
        const float off = std::max(std::fabs(hit.x), std::fabs(hit.y));
        if (std::fabs(off - 1) < 0.15f) continue;  // the pixel sees its edge
        lit += off < 1;
        EXPECT_NEAR(p.at(x, y).x, off < 1 ? bright : 0, 1e-3f) << x << "," << y;
      }
    EXPECT_GT(lit, 50);
  };
  check(100);
  std::swap(pack.emitters[0].corners[1], pack.emitters[0].corners[3]);  // its dark side
  check(0);
  pack.emitters[0].two_sided = true;
  check(100);
  pack.emitters[0].corners.pop_back();  // a triangle
  EXPECT_TRUE(draw(pack, camera, 65, 49, options).finite());
}

// From a coin to a kilometre, from straight before to edge-on, in every mode: no number that is none.
TEST_F(Reflected, EverySizeEveryAngleEveryMode) {
  for (const float scale : {1e-3f, 1.0f, 1e3f}) {
    Pack pack = pack_of_mirror();
    for (Vec3& p : pack.mesh.positions) p *= scale;
    pack.reflectors[0].lower *= scale;
    pack.reflectors[0].upper *= scale;
    for (RadianceMap& map : pack.radiance_maps) {
      map.eye *= scale;
      map.lower *= scale;
      map.upper *= scale;
    }
    for (const Reflections mode : {Reflections::kChosen, Reflections::kGeometry})
      for (const Vec3& eye : {Vec3(0, 0, 1), Vec3(3, 0, 1e-3f), Vec3(3, 0, 1e-6f), Vec3(0, 0, 0), Vec3(0.2f, 0, -1),
                              Vec3(0, 0, 3000), Vec3(900, 0, 1)}) {
        FrameOptions options;
        options.reflections = mode;
        options.show = Show::kM;
        const Picture p = draw(pack, camera_before(eye * scale, {0.01f * scale, 0, 0}), 48, 32, options);
        EXPECT_TRUE(p.finite()) << scale << " " << eye.x << " " << eye.z;
      }
    FrameOptions image;
    image.show = Show::kM;
    EXPECT_NEAR(draw(pack, camera_before(Vec3(0, 0, 1) * scale), 48, 32, image).at(24, 16).x, kReflectedGrey.x, 1e-3f)
        << scale;
  }
}

// Blur off is M; what touches the mirror is blurred less than what is far away.
TEST_F(Reflected, BlurModes) {
  Pack pack = pack_of_mirror();
  RadianceMap& map = pack.radiance_maps[0];
  for (std::uint32_t i = 0; i < map.width * map.height; ++i) {
    map.radiance[i] = i % map.width < map.width / 2 ? Vec3(40) : Vec3(0);
    map.disparity[i] = i / map.width < map.height / 2 ? 0.999f : 0.1f;  // below, on the mirror; above, far away
  }
  BrdfKernel kernel;
  kernel.size = 9;
  kernel.half_extent = 0.4f;
  kernel.weights.assign(81, 1.0f / 81);
  pack.kernels.push_back(kernel);
  pack.materials[0].kernel = 0;
  const auto rise = [&](Blur blur, int y) {  // pixels over which the edge goes from a tenth to nine
    FrameOptions options;
    options.show = Show::kMK;
    options.blur = blur;
    const Picture p = draw(pack, camera_before({0, 0, 1}), 160, 120, options);
    int between = 0;
    for (int x = 40; x < 120; ++x) between += p.at(x, y).x > 4 && p.at(x, y).x < 36;
    return between;
  };
  EXPECT_GT(rise(Blur::kDistance, 40), 2 * rise(Blur::kDistance, 95));
  EXPECT_LE(rise(Blur::kOff, 40), rise(Blur::kDistance, 95) + 1);
}

}  // namespace
}  // namespace oriel
