// bake/transfer/probes.h and formats/query: against light that is known, behind walls and pillars, at the extremes.
#include "bake/transfer/probes.h"

#include <gtest/gtest.h>

#include "bake/trace/path.h"
#include "formats/core/octahedral.h"
#include "formats/core/sh.h"
#include "formats/query/light_at.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel {
namespace {

using test::SceneParts;

// Surfaces show their emission, and what `reflected` says of the place beside it.
LightField field_of(const Scene& scene, const FieldBox& box, const ProbeOptions& options,
                    const std::function<Vec3(const Vec3&)>& reflected = {}, int threads = 2) {
  const auto accel = Accel::build(scene);
  const LightSet lights(scene);
  Context context;
  context.threads = threads;
  const SurfaceRadiance radiance = [&](const Hit& hit, const Vec3& towards_eye, bool with_emission) {
    const SurfacePoint p = surface_at(scene, hit, -towards_eye);
    return (with_emission && p.emits ? p.shade.emission : Vec3(0)) + (reflected ? reflected(p.position) : Vec3(0));
  };
  return bake_probes({accel.value(), lights, radiance}, box, options, context).value();
}

float mean_radiance(const std::vector<float>& sh, std::size_t channel = 0) {
  return sh[channel * sh.size() / 3] / std::sqrt(4 * kPi);
}

TEST(Octahedral, SquareAndSphereAreEachOthersInverse) {
  Vec3 mean(0);
  for (int x = 0; x < 64; ++x)
    for (int y = 0; y < 64; ++y) {
      const Vec2 u = (Vec2(x, y) + 0.5f) / 64.0f;
      const Vec3 d = sphere_from_square(u);
      mean += d * d;
      EXPECT_NEAR(glm::length(d), 1, 1e-5);
      EXPECT_NEAR(glm::length(square_from_sphere(d) - u), 0, 1e-4);
    }
  // Areas are kept: second moments of even directions.
  for (int a = 0; a < 3; ++a) EXPECT_NEAR(mean[a] / 4096, 1.0f / 3, 1e-3);
  // Beyond an edge the map goes on where the sphere does.
  for (const IVec2& at : {IVec2(-1, 3), IVec2(16, 9), IVec2(5, -1), IVec2(2, 16)}) {
    const Vec2 inside = (Vec2(glm::clamp(at, IVec2(0), IVec2(15))) + 0.5f) / 16.0f;
    const Vec2 beyond = (Vec2(wrap_octahedral(at, 16)) + 0.5f) / 16.0f;
    EXPECT_GT(glm::dot(sphere_from_square(inside), sphere_from_square(beyond)), 0.9f);
  }
}

TEST(Probes, AnEvenSkyIsItsMean) {
  SceneParts parts;
  parts.box("pebble", parts.diffuse(Vec3(0.5f)), {5000, 0, 0}, {5000.1f, 0.1f, 0.1f});
  Scene scene = parts.finish();
  scene.sky = {100, 50, 0};
  const LightField field = field_of(scene, {Vec3(-1), Vec3(1)}, {.samples = 4096});
  EXPECT_EQ(field.probes.size(), 27u);  // nothing to refine
  for (const LightProbe& probe : field.probes) {
    EXPECT_TRUE(probe.valid);
    EXPECT_NEAR(mean_radiance(probe.sh), 100, 0.01);
    EXPECT_EQ(mean_radiance(probe.sh, 2), 0);
    for (std::size_t i = 1; i < 25; ++i) EXPECT_NEAR(probe.sh[i], 0, 1.0);
    for (const Vec2& depth : probe.depth) EXPECT_EQ(depth, Vec2(1));
  }
  const LocalLight light = light_at(field, {0.3f, -0.2f, 0.9f});
  EXPECT_NEAR(mean_radiance(light.sh), 100, 0.01);
  EXPECT_EQ(light.trust, 1);
  EXPECT_TRUE(light.bright.empty());
}

// Two rooms side by side, the left one bright. The wall between them is on no plane of the grid.
constexpr float kWall = 4.4f;
Scene two_rooms(float wall) {
  SceneParts parts;
  const std::uint32_t grey = parts.diffuse(Vec3(0.5f));
  parts.box("rooms", grey, Vec3(0), {8, 3, 2}, true);
  parts.box("wall", grey, {kWall - wall / 2, 0, 0}, {kWall + wall / 2, 3, 2});
  return parts.finish();
}
Vec3 left_is_bright(const Vec3& p) {
  return Vec3(p.x < kWall ? 100.0f : 0.0f);
}

TEST(Probes, AThinWallLeaksNothing) {
  LightField field = field_of(two_rooms(0.05f), {Vec3(0), {8, 3, 2}}, {}, left_is_bright);
  float worst = 0, least = 100;
  for (const float y : {0.3f, 1.1f, 1.5f, 2.6f})
    for (const float z : {0.2f, 0.9f, 1.3f, 1.8f})
      for (const float x : {0.03f, 0.1f, 0.3f, 0.8f, 2.0f}) {
        worst = std::max(worst, mean_radiance(light_at(field, {kWall + x, y, z}).sh));
        worst = std::max(worst, mean_radiance(light_at(field, {kWall + x, y, z}, {-1, 0, 0}).sh));
        least = std::min(least, mean_radiance(light_at(field, {kWall - x, y, z}).sh));
      }
  EXPECT_LT(worst, 1);
  EXPECT_GT(least, 99);
  // It is their depth that tells the sides apart.
  for (LightProbe& probe : field.probes) probe.depth.assign(probe.depth.size(), Vec2(1));
  EXPECT_GT(mean_radiance(light_at(field, {kWall + 0.03f, 1.5f, 1.3f}).sh), 10);
}

TEST(Probes, InsideWallsTheyAreInvalid) {
  SceneParts parts;
  const std::uint32_t grey = parts.diffuse(Vec3(0.5f));
  parts.box("room", grey, Vec3(-2), Vec3(2), true);
  parts.box("block", grey, Vec3(-0.6f), Vec3(0.6f));
  const LightField field =
      field_of(parts.finish(), {Vec3(-2), Vec3(2)}, {.spacing_m = 2, .levels = 0}, [](const Vec3&) { return Vec3(7); });
  std::size_t invalid = 0;
  for (const LightProbe& probe : field.probes) {
    EXPECT_EQ(probe.valid, glm::length(probe.position) > 0.1f);
    EXPECT_NEAR(mean_radiance(probe.sh), 7, 1e-3);  // the one inside has its neighbour's
    invalid += !probe.valid;
  }
  EXPECT_EQ(invalid, 1u);
  EXPECT_NEAR(mean_radiance(light_at(field, Vec3(0.05f)).sh), 7, 1e-3);
}

// A red wall hides behind a pillar: beside it, the field is as good as a probe on the spot.
TEST(Probes, APillarTakesAwayTheColourOfAWall) {
  SceneParts parts;
  const std::uint32_t grey = parts.diffuse(Vec3(0.5f));
  parts.box("room", grey, Vec3(0), {6, 3, 6}, true);
  parts.box("pillar", grey, {1.5f, 0, 2}, {2, 3, 4});
  const Scene scene = parts.finish();
  const auto red_wall = [](const Vec3& p) { return p.x < 0.01f ? Vec3(100, 0, 0) : Vec3(0, 10, 0); };
  const auto colour = [](const LocalLight& light) {
    return Vec3(mean_radiance(light.sh, 0), mean_radiance(light.sh, 1), mean_radiance(light.sh, 2));
  };
  const auto worst = [&](const ProbeOptions& options) {
    const LightField field = field_of(scene, {Vec3(0), {6, 3, 6}}, options, red_wall);
    float difference = 0;
    for (const Vec3& p : {Vec3(2.2f, 1.5f, 3), Vec3(2.5f, 1.2f, 2.4f), Vec3(3, 1, 3.2f), Vec3(1, 1.5f, 3)}) {
      const Vec3 half(0.02f);
      const LightField there = field_of(scene, {p - half, p + half}, {.levels = 0}, red_wall);
      const Vec3 expected = colour(light_at(there, p)), found = colour(light_at(field, p));
      difference = std::max(difference, glm::length(found - expected) / glm::length(expected));
    }
    return difference;
  };
  const float coarse = worst({.spacing_m = 1.5f, .levels = 0}), fine = worst({.spacing_m = 1.5f});
  EXPECT_LT(fine, 0.15f);
  EXPECT_LT(fine, 0.6f * coarse);
}

// A lamp of 10 000 cd/m² alone in the dark.
Scene lamp(float side) {
  SceneParts parts;
  parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(1e4f)), {0, 3, 0}, {side, 0, 0}, {0, 0, side});
  return parts.finish();
}

TEST(Probes, ALampLeftInTheHarmonicsKeepsItsEnergyAndItsIrradianceNeverRingsBelowZero) {
  const Scene scene = lamp(0.1f);
  const LightField field = field_of(scene, {{-1, 0, -1}, {1, 2, 1}}, {.levels = 0, .bright_lights = 0});
  EXPECT_TRUE(field.lights.empty());
  const PolygonLight polygon = find_polygon_lights(scene)[0];
  std::vector<float> y(25);
  for (const LightProbe& probe : field.probes) {
    // Small as seen from there: solid angle times radiance.
    const Vec3 to = polygon.center - probe.position;
    const float cosine = std::abs(glm::dot(polygon.normal, to)) / glm::length(to);
    const float expected = glm::dot(polygon.normal, to) < 0 ? 1e4f * 0.01f * cosine / glm::dot(to, to) / (4 * kPi) : 0;
    EXPECT_NEAR(mean_radiance(probe.sh), expected, 0.02f * expected);
    for (int i = 0; i < 2000; ++i) {
      const Vec3 d = sphere_from_square(Vec2(i % 50, i / 50) / Vec2(50, 40));
      evaluate_sh(d, y);
      float irradiance = 0;
      for (int l = 0; l < 5; ++l)
        for (auto k = static_cast<std::size_t>(l * l); k < static_cast<std::size_t>((l + 1) * (l + 1)); ++k)
          irradiance += static_cast<float>(cosine_factor(l)) * probe.sh[k] * y[k];
      EXPECT_GE(irradiance, -2e-3f * kPi * mean_radiance(probe.sh));
    }
  }
}

TEST(Probes, BrightLightsAreLeftOutAndListed) {
  Scene scene = lamp(0.5f);
  Light point;
  point.name = "bulb";
  point.position = {0.5f, 1, 0.4f};
  point.intensity = {300, 200, 100};
  scene.lights.push_back(point);
  const FieldBox box{{-1, 0, -1}, {1, 2, 1}};
  const LightField with = field_of(scene, box, {.levels = 0});
  ASSERT_EQ(with.lights.size(), 2u);
  EXPECT_EQ(with.lights[0].kind, BrightLightKind::kPolygon);
  EXPECT_EQ(with.lights[0].corners.size(), 6u);
  EXPECT_EQ(with.lights[0].intensity, Vec3(1e4f));
  EXPECT_EQ(with.lights[1].name, "bulb");
  EXPECT_EQ(with.lights[1].intensity, point.intensity);
  const Vec3 p(0.1f, 0.4f, 0.2f);
  const LocalLight without_them = light_at(with, p);
  EXPECT_EQ(mean_radiance(without_them.sh), 0);
  ASSERT_EQ(without_them.bright.size(), 2u);
  EXPECT_EQ(without_them.bright[1].share, 1);
  // The strongest alone: the other stays in the harmonics, wholly or in part.
  const LocalLight one = light_at(field_of(scene, box, {.levels = 0, .bright_lights = 1}), p);
  EXPECT_GT(mean_radiance(one.sh), 0);
  float share = 0;
  for (const auto& light : one.bright) share += light.share;
  EXPECT_NEAR(share, 1, 1e-5);
}

TEST(Probes, TheSameForAnyNumberOfThreads) {
  const LightField a = field_of(two_rooms(0.2f), {Vec3(0), {8, 3, 2}}, {.samples = 256}, left_is_bright, 1);
  const LightField b = field_of(two_rooms(0.2f), {Vec3(0), {8, 3, 2}}, {.samples = 256}, left_is_bright, 3);
  ASSERT_EQ(a.probes.size(), b.probes.size());
  EXPECT_EQ(a.error, b.error);
  for (std::size_t i = 0; i < a.probes.size(); ++i) {
    EXPECT_EQ(a.probes[i].sh, b.probes[i].sh);
    EXPECT_EQ(a.probes[i].depth, b.probes[i].depth);
  }
}

TEST(Probes, TheirNumberIsBounded) {
  Context context;
  std::string said;
  context.warn = [&](const Warning& warned) { said += warned.text; };
  const Scene scene = two_rooms(0.2f);
  const auto accel = Accel::build(scene);
  const SurfaceRadiance radiance = [&](const Hit& hit, const Vec3&, bool) {
    return left_is_bright(point_on(scene, hit.triangle, hit.barycentric));
  };
  ProbeOptions options{.spacing_m = 1e-4f, .samples = 64, .depth_side = 8, .max_probes = 300, .max_difference = 0};
  const auto field = bake_probes({accel.value(), LightSet(scene), radiance}, {Vec3(0), {8, 3, 2}}, options, context);
  ASSERT_TRUE(field);
  EXPECT_LE(field->probes.size(), 600u);
  EXPECT_GT(field->probes.size(), 300u);
  EXPECT_NE(said.find("m between probes instead of"), std::string::npos) << said;
  for (const ProbeOptions& bad : {ProbeOptions{.bands = 7}, ProbeOptions{.spacing_m = 0}, ProbeOptions{.samples = 1000},
                                  ProbeOptions{.samples = 128}, ProbeOptions{.levels = 3}})
    EXPECT_EQ(bake_probes({accel.value(), LightSet(scene), radiance}, {Vec3(0), Vec3(1)}, bad, context).error().code,
              ErrorCode::kUsage);
}

// Where time is over, the level of refinement under way is left out, and what was there before stays as it was.
TEST(Probes, RefinementEndsWhereTimeIsOver) {
  const FieldBox box{Vec3(0), {8, 3, 2}};
  std::atomic<int> shaded{0};
  const auto counted = [&](const Vec3& p) { return ++shaded, left_is_bright(p); };
  const auto plain = field_of(two_rooms(0.2f), box, {.samples = 256, .levels = 0}, counted);
  const int of_grid = shaded.exchange(0);
  const auto whole = field_of(two_rooms(0.2f), box, {.samples = 256}, left_is_bright);
  ASSERT_GT(whole.cells.size(), plain.cells.size());
  const auto left = [&] { return shaded <= of_grid ? 1.0 : 0.0; };
  const auto ended = field_of(two_rooms(0.2f), box, {.samples = 256, .left = left}, counted);
  ASSERT_EQ(ended.cells.size(), plain.cells.size());
  ASSERT_EQ(ended.probes.size(), plain.probes.size());
  for (const FieldCell& cell : ended.cells) EXPECT_EQ(cell.children, FieldCell().children);
  for (std::size_t i = 0; i < plain.probes.size(); ++i) EXPECT_EQ(ended.probes[i].sh, plain.probes[i].sh);
}

// Before that, what is not measured has the light of the nearest probe that is: a few rays for all.
TEST(Probes, TheGridEndsWhereTimeIsOver) {
  const FieldBox box{Vec3(0), {8, 3, 2}};
  std::atomic<int> shaded{0};
  const auto counted = [&](const Vec3& p) { return ++shaded, left_is_bright(p); };
  const auto plain = field_of(two_rooms(0.2f), box, {.samples = 256, .levels = 0}, counted, 1);
  const int of_grid = shaded.exchange(0);
  const auto ended = field_of(two_rooms(0.2f), box, {.samples = 256, .left = [] { return 0.0; }}, counted, 1);
  EXPECT_LT(shaded, of_grid / 4);
  ASSERT_EQ(ended.probes.size(), plain.probes.size());
  EXPECT_EQ(ended.cells.size(), plain.cells.size());
  std::set<std::vector<float>> lights;
  for (const LightProbe& probe : ended.probes) {
    EXPECT_EQ(probe.sh.size(), plain.probes[0].sh.size());
    EXPECT_EQ(probe.depth.size(), plain.probes[0].depth.size());
    lights.insert(probe.sh);
  }
  EXPECT_EQ(lights.size(), 1u) << "of the one that was measured";
}

}  // namespace
}  // namespace oriel
