// Light in half floats: to their precision what floats show, and never where a light is beyond them.
#include <cmath>

#include "formats/core/color.h"
#include "tests/player/frame_fixture.h"

namespace oriel {
namespace {
using namespace testing;

constexpr int kSize = 48;

// A wall lit by `lux` behind a mirror that shows a lamp of `lamp` cd/m².
Pack lit_wall(float lux, float lamp) {
  Pack pack;
  add_mirror(pack, {{0, 0, -3}}, 64, [&](const Vec2& at, const Vec3&) {
    return Seen{at.x < 0 ? Vec3(0.5f * lamp, 0.3f * lamp, 0.1f * lamp) : Vec3(3, 2, 1), 2};
  });
  pack.materials.resize(3);
  pack.materials[0].fresnel_map = 0;
  pack.fresnel_maps.push_back(flat_reflectance(Vec3(0.5f)));
  pack.materials[1].base_color = {0.7f, 0.5f, 0.3f};
  pack.materials[2].emission = Vec3(lamp);
  pack.lightmaps.push_back(flat_page(Vec3(lux)));
  add_quad(pack, {-3, -3, -0.5f}, {6, 0, 0}, {0, 6, 0}, 1, 0);
  add_quad(pack, {1.2f, -0.5f, 0.1f}, {1, 0, 0}, {0, 1, 0}, 2, -1);
  return pack;
}

class Halves : public FrameTest {
 protected:
  Picture draw_with(const Pack& pack, bool halves, std::vector<Vec3> lights = {}) {
    Camera camera;
    camera.eye = {0.3f, 0.2f, 2};
    FrameOptions options;
    options.halves = halves;
    options.samples = 4;
    options.lights = std::move(lights);
    return draw(pack, camera, kSize, kSize, options);
  }
};

float largest_difference(const Picture& a, const Picture& b) {
  float most = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i)
    most = std::max(most, std::fabs(a.rgb[i] - b.rgb[i]) / std::max(b.rgb[i], 1e-3f));
  return most;
}

TEST_F(Halves, ShowWhatFloatsDo) {
  for (const float lux : {0.05f, 300.0f, 90000.0f}) {
    const Pack pack = lit_wall(lux, std::max(lux, 1.0f) / 3);
    const Picture halves = draw_with(pack, true), floats = draw_with(pack, false);
    const float apart = largest_difference(halves, floats);
    EXPECT_LT(apart, 4e-3f) << lux << " lux";
    EXPECT_GT(apart, 0) << lux << " lux: they were not used";
  }
}

// Where a mirror shows it alpha tells it from a hole.
TEST_F(Halves, ShowTheSkyInMirrors) {
  for (const Reflections way : {Reflections::kGeometry, Reflections::kChosen}) {
    Pack pack;
    add_mirror(pack, {{0, 0, -3}}, 64, [](const Vec2&, const Vec3&) { return Seen{{40, 50, 60}, INFINITY}; });
    pack.materials.resize(1);
    pack.materials[0].fresnel_map = 0;
    pack.fresnel_maps.push_back(flat_reflectance(Vec3(0.5f)));
    pack.sky = {40, 50, 60};
    Camera camera;
    camera.eye = {0.3f, 0.2f, 2};
    FrameOptions options;
    options.reflections = way;
    const Vec3 floats = draw(pack, camera, kSize, kSize, options).at(kSize / 2, kSize / 2);
    options.halves = true;
    const Vec3 halves = draw(pack, camera, kSize, kSize, options).at(kSize / 2, kSize / 2);
    EXPECT_GT(floats.g, 10);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(halves[c], floats[c], 2e-3f * floats[c]);
  }
}

// The image of a reflector is not made of them then, so that nothing beside is spoilt; the frame shows white.
TEST_F(Halves, AreNotForMapsBeyondThem) {
  Pack pack;
  add_mirror(pack, {{0, 0, -3}}, 64, [](const Vec2& at, const Vec3&) {
    return Seen{Vec3(at.x < 0 ? 1e6f : 3.3f), INFINITY};
  });
  pack.materials.resize(1);
  pack.materials[0].fresnel_map = 0;
  pack.fresnel_maps.push_back(flat_reflectance(Vec3(0.5f)));
  const Picture halves = draw_with(pack, true), floats = draw_with(pack, false);
  int bright = 0;
  for (std::size_t i = 0; i < floats.rgb.size(); ++i) {
    const bool beyond = floats.rgb[i] > 1e4f;  // at edges the mean of such samples and others
    bright += beyond;
    EXPECT_TRUE(beyond ? halves.rgb[i] > 1e4f : std::fabs(halves.rgb[i] - floats.rgb[i]) <= 4e-3f * floats.rgb[i])
        << i << ": " << halves.rgb[i] << " " << floats.rgb[i];
  }
  EXPECT_GT(bright, 300);
}

TEST_F(Halves, AreNotForLightBeyondThem) {
  for (const auto& [lux, lamp] : {std::pair(300.0f, 1e6f), std::pair(1e6f, 100.0f)}) {
    const Pack pack = lit_wall(lux, lamp);
    EXPECT_EQ(draw_with(pack, true).rgb, draw_with(pack, false).rgb) << lux << " lux, " << lamp << " cd/m2";
  }
}

TEST_F(Halves, NorForLampsThatAreTurnedUp) {
  Pack pack;
  pack.materials.resize(1);
  pack.materials[0].emission = {20000, 3000.3f, 7};
  add_quad(pack, {-3, -3, 0}, {6, 0, 0}, {0, 6, 0}, 0, -1);
  LightGroup lamp;
  lamp.name = "lamp", lamp.materials = {0};
  pack.light_groups = {lamp};
  EXPECT_NE(draw_with(pack, true).rgb, draw_with(pack, false).rgb);
  EXPECT_EQ(draw_with(pack, true, {Vec3(8)}).rgb, draw_with(pack, false, {Vec3(8)}).rgb);
}

}  // namespace
}  // namespace oriel
