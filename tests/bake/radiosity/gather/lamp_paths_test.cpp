// Light of lamps by way of specular reflections, followed from the lamps.
#include "bake/radiosity/gather/lamp_paths.h"

#include <gtest/gtest.h>

#include "bake/radiosity/gather/gather.h"
#include "formats/core/color.h"
#include "tests/bake/radiosity/listed.h"

namespace oriel::test {
namespace {

SceneMaterial polished(const Vec3& color, float metallic, float roughness) {
  SceneMaterial m;
  m.name = "polished";
  m.base_color = color;
  m.metallic = metallic;
  m.roughness = roughness;
  return m;
}

constexpr float kLampSide = 0.2f, kLampHeight = 1;  // m

// A lamp over a floor, which shines down only, and beside it, twice as high, a matt ceiling of 1 m².
Scene lamp_over(const SceneMaterial& floor, float lamp_luminance) {
  SceneParts parts;
  parts.quad("ceiling", parts.diffuse(Vec3(0.5f)), {1.5f, 2, -0.5f}, {1, 0, 0}, {0, 0, 1});
  parts.quad("floor", parts.add(floor), {-4, 0, -4}, {0, 0, 8}, {8, 0, 0});
  const float h = kLampSide / 2;
  parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(lamp_luminance)), {-h, kLampHeight, -h}, {kLampSide, 0, 0},
             {0, 0, kLampSide});
  return parts.finish();
}

double mean_of(const Listed& listed, std::span<const std::uint32_t> texels, const LampLight& light) {
  double flux = 0, area = 0;
  for (const std::uint32_t i : texels) {
    flux += double{listed.texels.area_m2[i]} * 0.5 * (light.half(0, i).g + light.half(1, i).g);
    area += listed.texels.area_m2[i];
  }
  return flux / area;
}

// A perfect mirror shows the lamp as far below the floor as it hangs above: E = L ∫∫ cos² / d² over lamp and ceiling.
TEST(LampPaths, AMirrorShowsTheLampWhereItsImageIs) {
  constexpr float kLuminance = 1000;
  Listed listed(lamp_over(polished(Vec3(1), 1, 0), kLuminance), 0.25f);
  double expected = 0;
  constexpr int kGrid = 24, kLampGrid = 4;
  for (int k = 0; k < kGrid * kGrid * kLampGrid * kLampGrid; ++k) {
    const auto at = [&](int n, int of) { return (n % of + 0.5) / of; };
    const double x = 1.5 + at(k, kGrid), z = -0.5 + at(k / kGrid, kGrid);
    const double u = kLampSide * (at(k / (kGrid * kGrid), kLampGrid) - 0.5);
    const double v = kLampSide * (at(k / (kGrid * kGrid * kLampGrid), kLampGrid) - 0.5);
    const double height = 2 + kLampHeight, d2 = (x - u) * (x - u) + (z - v) * (z - v) + height * height;
    expected += height * height / (d2 * d2);
  }
  expected *= kLuminance * kLampSide * kLampSide / (kGrid * kGrid * kLampGrid * kLampGrid);
  std::atomic<std::uint64_t> rays{0};
  const Transport transport = listed.transport();
  const CacheQuery query(transport, listed.texels, true, 1);
  LampLight light(listed.texels.count(), true);
  ASSERT_TRUE(trace_lamps(listed.texels, query, 1u << 19, {listed.context, &rays}, light));
  EXPECT_EQ(light.particles, 1u << 19);
  EXPECT_NEAR(mean_of(listed, listed.floor, light) / expected, 1, 0.01);
  // From the lamp's image: down, and towards it.
  const Vec4& moments = light.moments[listed.floor[listed.floor.size() / 2]];
  const Vec3 towards = glm::normalize(Vec3(moments)), image = glm::normalize(Vec3(-2, -3, 0));
  EXPECT_GT(glm::dot(towards, image), 0.99f);
  EXPECT_GT(rays, 2u << 19);
}

TEST(LampPaths, PointsInMirrorsAreLeftOutAsPathsMissThem) {
  for (const float roughness : {0.0f, 0.2f}) {
    Scene scene = lamp_over(polished(Vec3(1), 1, roughness), 0);
    Light lamp;
    lamp.type = LightType::kPoint;
    lamp.position = Vec3(0, 0.9f * kLampHeight, 0);
    lamp.intensity = Vec3(100);
    scene.lights = {lamp};
    Listed listed(std::move(scene), 0.5f);
    const Transport transport = listed.transport();
    const CacheQuery query(transport, listed.texels, true, 1);
    LampLight light(listed.texels.count(), false);
    ASSERT_TRUE(trace_lamps(listed.texels, query, 1u << 14, listed.context, light));
    EXPECT_EQ(mean_of(listed, listed.floor, light) > 0, roughness > 0);
  }
}

TEST(LampPaths, CostNothingWhereNoLampIsNear) {
  Listed listed(lamp_over(polished(Vec3(1), 1, 0), 0), 0.5f);
  std::atomic<std::uint64_t> rays{0};
  const Transport transport = listed.transport();
  LampLight light(listed.texels.count(), false);
  ASSERT_TRUE(trace_lamps(listed.texels, CacheQuery(transport, listed.texels, true, 1), 1u << 14,
                          {listed.context, &rays}, light));
  EXPECT_EQ(light.particles, 0u);
  EXPECT_EQ(rays, 0u);
}

enum class Glass : std::uint8_t { kThin, kSolid, kFrosted };

class LampPathsBesideGlass : public ::testing::TestWithParam<std::tuple<Glass, bool>> {};

// Lamps or a sun, a plinth that the floor's texels see from nearer than paths leave off, a pane or a block of glass and
// a mirror: what rays and particles find together is what rays find alone, nothing of it twice.
TEST_P(LampPathsBesideGlass, AddUpWithRaysToAllLight) {
  SceneParts parts;
  const auto matt = parts.diffuse(Vec3(0.6f));
  SceneMaterial glass = polished(Vec3(1), 0, 0.3f);
  glass.transmission = 0.8f;
  glass.double_sided = true;
  parts.quad("floor", parts.add(polished(Vec3(0.5f), 0, 0.4f)), {-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
  parts.quad("wall", matt, {-1, 0, -1}, {2, 0, 0}, {0, 2, 0});
  parts.quad("side", parts.add(polished(Vec3(0.9f), 1, 0.4f)), {-1, 0, 1}, {0, 0, -2}, {0, 2, 0});
  parts.box("plinth", parts.add(polished(Vec3(0.7f), 0, 0.5f)), {0.1f, 0, -0.3f}, {0.6f, 0.25f, 0.2f});
  const auto [kind, sunlit] = GetParam();
  glass.solid = kind != Glass::kThin;
  if (kind == Glass::kSolid) glass.roughness = 0;
  if (glass.solid)
    parts.box("block", parts.add(glass), {0.2f, 1e-3f, 0.4f}, {0.7f, 0.6f, 0.6f});
  else
    parts.quad("pane", parts.add(glass), {0.2f, 0, 0.5f}, {0.5f, 0, 0}, {0, 0.6f, 0});
  Light bulb;
  bulb.position = Vec3(0.4f, 0.8f, 0.7f);
  bulb.intensity = Vec3(5);
  if (sunlit) {
    bulb.type = LightType::kDirectional;
    bulb.direction = glm::normalize(Vec3(-0.6f, -1, -0.5f));
    bulb.angular_radius_rad = 0.02f;
  } else {
    parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(500)), {-0.3f, 1.2f, -0.3f}, {0.3f, 0, 0}, {0, 0, 0.3f});
  }
  parts.scene().lights = {bulb};
  Listed listed(parts.finish(), 0.1f);
  const Transport transport = listed.transport();
  std::atomic<std::uint64_t> rays{0};
  const TexelGraph graph = *find_neighbours(transport, listed.texels, {listed.context, &rays});
  const std::vector<Vec3> dark(listed.texels.count(), Vec3(0));
  const CachedLight cached = cache_light(listed.texels, graph, dark, listed.context);
  const auto order = coherent_order(listed.texels);
  LampLight light(listed.texels.count(), false);
  const auto flux = [&](bool by_particles) {
    CacheQuery query(transport, listed.texels, true, 1);
    query.set_survival(std::vector<float>(listed.scene.materials.size(), 64.0f));
    HalfSums sums(listed.texels.count(), false);
    if (by_particles) {
      EXPECT_TRUE(trace_lamps(listed.texels, query, 1u << 18, {listed.context, &rays}, light));
      query.leave_out_lamps();
      for (int h = 0; h < kHalves; ++h)
        for (std::size_t i = 0; i < dark.size(); ++i) sums.additional[h][i] = light.half(h, i);
    }
    EXPECT_TRUE(
        (FinalGather{listed.sample_points(transport), query, cached}.run(order, 512, {listed.context, &rays}, sums)));
    double total = 0, beside = 0;
    for (std::size_t i = 0; i < dark.size(); ++i) {
      const double lit_m2 = listed.texels.area_m2[i] * listed.texels.visible[i];
      total += lit_m2 * luminance(sums.mean(i)), beside += lit_m2 * luminance(sums.additional[0][i]);
    }
    return std::pair(total, beside / total);
  };
  const auto [alone, nothing] = flux(false);
  const auto [together, by_particles] = flux(true);
  EXPECT_NEAR(together / alone, 1, 0.01);
  EXPECT_EQ(nothing, 0);
  EXPECT_GT(by_particles, 0.3) << "particles bring too little of it: the test shows nothing";
  EXPECT_LT(by_particles, 0.9) << "rays do";
}
INSTANTIATE_TEST_SUITE_P(All, LampPathsBesideGlass,
                         ::testing::Combine(::testing::Values(Glass::kThin, Glass::kSolid, Glass::kFrosted),
                                            ::testing::Bool()));

// A closed box of perfect metal fills with light until the lamp takes in what it sends: E = πL on every wall. What
// comes straight from the lamp is no particle's.
TEST(LampPaths, FillABoxOfMetal) {
  constexpr float kLuminance = 10, kLamp = 0.25f, kRoom = 2;  // half sides, m
  SceneParts parts;
  parts.box("room", parts.add(polished(Vec3(1), 1, 0.6f)), Vec3(-kRoom), Vec3(kRoom), true);
  parts.box("lamp", parts.diffuse(Vec3(0), Vec3(kLuminance)), Vec3(-kLamp), Vec3(kLamp));
  const Listed listed(parts.finish(), 0.5f);
  const Transport transport = listed.transport();
  const CacheQuery query(transport, listed.texels, true, 1);
  LampLight light(listed.texels.count(), false);
  Context context;
  ASSERT_TRUE(trace_lamps(listed.texels, query, 4096, context, light));
  std::vector<std::uint32_t> walls;
  for (std::uint32_t i = 0; i < listed.texels.count(); ++i)
    if (max_component(glm::abs(listed.texels.sample_points[i][0].origin)) > 0.9f * kRoom) walls.push_back(i);
  const double straight = kLamp * kLamp / (kRoom * kRoom);
  EXPECT_NEAR(mean_of(listed, walls, light) / (kPi * kLuminance), 1 - straight, 0.1);
}

}  // namespace
}  // namespace oriel::test
