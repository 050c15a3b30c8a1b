// Few lights that stand for all light: what they give is what the surfaces and the sky give.
#include "formats/query/scattered_lights.h"

#include <gtest/gtest.h>

#include "tests/formats/query/lit_cube.h"

namespace oriel {
namespace {

// As if nothing were between.
Vec3 irradiance(std::span<const ScatteredLight> lights, const Vec3& p, const Vec3& normal) {
  Vec3 sum(0);
  for (const ScatteredLight& l : lights) sum += unshadowed(l.light, p, normal);
  return sum;
}

struct Drawn {
  LitCube cube;
  std::unique_ptr<LampScene> scene;
  ScatterSources sources;

  explicit Drawn(const std::function<void(LitCube&)>& change, std::vector<Vec3> emission = {Vec3(0)}) {
    change(cube);
    scene = std::make_unique<LampScene>(cube.scene());
    const std::vector<std::uint8_t> left_out(cube.mesh.parts.size(), 0);
    sources = ScatterSources({*scene, cube.pages, cube.points, emission, left_out});
  }
  std::vector<ScatteredLight> draw(std::uint32_t count, const Vec4& place = {0, 0, 0, 0.3f},
                                   const Vec3& sky = Vec3(0)) {
    return sources.draw(*scene, sky, std::vector<Vec4>{place}, count);
  }
};

void light_evenly(LitCube& cube, float lux) {
  for (LightmapPage& page : cube.pages) page.irradiance.assign(page.irradiance.size(), Vec3(lux));
}

TEST(ScatteredLights, StandForAllThatSurfacesReflect) {
  Drawn drawn([](LitCube& cube) { light_evenly(cube, 100); });
  EXPECT_NEAR(drawn.sources.flux().x, 24 * 100 * kLitAlbedo, 1);
  for (const std::uint32_t count : {64u, 512u}) {
    const auto lights = drawn.draw(count);
    EXPECT_LE(lights.size(), count);
    // In a room whose walls send out alike a surface in its middle gets as much from all sides.
    const float off = count == 64 ? 0.1f : 0.03f;
    for (const Vec3& normal : {Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0.6f, 0.8f)})
      EXPECT_NEAR(irradiance(lights, Vec3(0), normal).x, 100 * kLitAlbedo, off * 100 * kLitAlbedo) << count;
  }
}

TEST(ScatteredLights, ShineMoreOftenFromWhereMoreComes) {
  Drawn drawn([](LitCube& cube) {
    light_evenly(cube, 1);
    cube.pages[2].irradiance.assign(cube.pages[2].irradiance.size(), Vec3(1000));
  });
  std::size_t bright = 0;
  const auto lights = drawn.draw(128);
  for (const ScatteredLight& l : lights) bright += l.index == 2 ? 1 : 0;
  EXPECT_GT(10 * bright, 9 * lights.size());
}

// A wall between: what lies behind it does not matter here, and no light is spent on it.
TEST(ScatteredLights, AreNoneThatTheirPlacesDoNotSee) {
  Drawn drawn([](LitCube& cube) {
    light_evenly(cube, 100);
    cube.wall({0.2f, -1, -1}, {0, 0, 2}, {0, 2, 0});
    cube.wall({0.2f, -1, -1}, {0, 2, 0}, {0, 0, 2});
    cube.find_points();
  });
  std::size_t behind = 0;
  const auto lights = drawn.draw(128, {-0.5f, 0, 0, 0.3f});
  for (const ScatteredLight& l : lights) behind += l.light.position.x > 0.5f ? 1 : 0;
  EXPECT_LT(20 * behind, lights.size());
}

TEST(ScatteredLights, KnowWhatShines) {
  Drawn drawn([](LitCube&) {}, {Vec3(200)});
  const auto lights = drawn.draw(256);
  ASSERT_FALSE(lights.empty());
  EXPECT_EQ(lights[0].source, ScatterSource::kEmission);
  // From all sides the same; as disks lights give 3 % less at a distance of one metre.
  float mean = 0;
  for (const Vec3& n : {Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 0, 1), Vec3(0, 0, -1)})
    mean += irradiance(lights, Vec3(0), n).x / 6;
  EXPECT_NEAR(mean, 0.97f * 200 * kPi, 0.02f * 200 * kPi);
}

TEST(ScatteredLights, TheSkyHasItsOwn) {
  LitCube open;
  open.remove_wall(3);  // the one above
  LampScene scene = open.scene();
  const std::vector<std::uint8_t> left_out(open.mesh.parts.size(), 0);
  const std::vector<Vec3> emission{Vec3(0)};
  const ScatterSources sources({scene, open.pages, open.points, emission, left_out});
  const auto lights = sources.draw(scene, Vec3(10), std::vector<Vec4>{{0, 0, 0, 0.2f}}, 256);
  ASSERT_GT(lights.size(), 100u);
  Vec3 sum(0);
  std::uint32_t last = ~0u;
  for (const ScatteredLight& l : lights) {
    EXPECT_EQ(l.source, ScatterSource::kSky);
    LampScene::Blockers blockers{last, last};
    if (scene.sees(Vec3(0), l.light.position, Mat4(1), blockers)) sum += unshadowed(l.light, Vec3(0), Vec3(0, 1, 0));
  }
  // The square above: 2 by 2 metres at a distance of one; its form factor from below its middle.
  const float factor = 4 * 2 / (2 * kPi) * (1 / std::sqrt(2.0f)) * std::atan(1 / std::sqrt(2.0f));
  EXPECT_NEAR(sum.x, 10 * kPi * factor, 0.1f * 10 * kPi * factor);
}

TEST(ScatteredLights, OfNothingAreNone) {
  Drawn dark([](LitCube&) {});
  EXPECT_TRUE(dark.draw(64).empty());
  Drawn lit([](LitCube& cube) { light_evenly(cube, 100); });
  EXPECT_TRUE(lit.draw(0).empty());
  EXPECT_TRUE(lit.sources.draw(*lit.scene, Vec3(1), {}, 64).empty());
  EXPECT_EQ(lit.draw(1).size(), 1u);
}

}  // namespace
}  // namespace oriel
