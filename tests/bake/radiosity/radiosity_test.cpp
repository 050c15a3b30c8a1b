// Radiosity textures against closed forms: through the atlas and the texel map, as a bake runs.
#include <gtest/gtest.h>

#include <cstring>

#include "bake/radiosity/dilate.h"
#include "bake/radiosity/radiosity.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel {
namespace {

using test::SceneParts;

struct FurnaceBake {
  Scene scene;
  Atlas atlas;
  std::vector<TexelMapPage> texel_map;
  Radiosity radiosity;
};

FurnaceBake bake(Scene scene, float texel_m, std::uint32_t samples, int threads = 0) {
  FurnaceBake b;
  b.scene = std::move(scene);
  Context context;
  context.threads = threads;
  AtlasOptions options;
  options.texel_m = texel_m;
  b.atlas = *build_atlas(b.scene, options, context);
  b.texel_map = *build_texel_map(b.atlas, context);
  const Accel accel = *Accel::build(b.scene);
  const LightSet lights(b.scene);
  RadiosityOptions radiosity;
  radiosity.samples = samples;
  b.radiosity = *bake_radiosity({{accel, lights, {}}, b.atlas, b.texel_map}, radiosity, context);
  return b;
}

double surface_area(const Scene& scene) {
  double area = 0;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) area += triangle_area(scene, t);
  return area;
}

// The mean over the closed sphere is exact by flux balance: E = πL / (1 - ρ). 0.5 % is the acceptance line.
class BakedFurnace : public ::testing::TestWithParam<float> {};

TEST_P(BakedFurnace, MeanIrradianceIsTheSeries) {
  const float albedo = GetParam();
  SceneParts parts;
  parts.sphere("sphere", parts.diffuse(Vec3(albedo), Vec3(1)), Vec3(0), 1, 2, true);
  // Twenty bounces leave noise of 0.4 % to 64 samples.
  const FurnaceBake b = bake(parts.finish(), 0.1f, albedo > 0.9f ? 256 : 64);
  const double mean = b.radiosity.report.incident_lm.g / surface_area(b.scene);
  EXPECT_NEAR(mean * (1 - albedo) / kPiD, 1, 0.005);
  EXPECT_EQ(b.radiosity.report.buried, 0u);
}
INSTANTIATE_TEST_SUITE_P(Albedos, BakedFurnace, ::testing::Values(0.0f, 0.5f, 0.8f, 0.95f));

// A room with a lamp and a dark opening (a black portal, which absorbs what would escape): emitted = absorbed +
// escaped.
TEST(Radiosity, EnergyBalances) {
  SceneParts parts;
  const auto white = parts.diffuse(Vec3(0.7f));
  parts.quad("floor", white, {0, 0, 2}, {2, 0, 0}, {0, 0, -2});
  parts.quad("ceiling", white, {0, 2, 0}, {2, 0, 0}, {0, 0, 2});
  parts.quad("back", white, {0, 0, 0}, {2, 0, 0}, {0, 2, 0});
  parts.quad("left", parts.diffuse({0.6f, 0.05f, 0.05f}), {0, 0, 2}, {0, 0, -2}, {0, 2, 0});
  parts.quad("right", parts.diffuse({0.1f, 0.5f, 0.1f}), {2, 0, 0}, {0, 0, 2}, {0, 2, 0});
  parts.quad("portal", parts.diffuse(Vec3(0)), {2, 0, 2}, {-2, 0, 0}, {0, 2, 0});
  parts.box("block", white, {0.5f, 0, 0.4f}, {1.1f, 1.1f, 1});
  parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(10, 7, 4)), {0.7f, 1.99f, 0.7f}, {0.5f, 0, 0}, {0, 0, 0.5f});
  const FurnaceBake b = bake(parts.finish(), 0.08f, 256);
  DVec3 absorbed(0);
  for (std::size_t p = 0; p < b.texel_map.size(); ++p)
    for (std::size_t i = 0; i < b.texel_map[p].texel.size(); ++i) {
      const TexelFragment& f = b.texel_map[p].fragments[b.texel_map[p].first[i]];
      const Vec3 albedo = b.scene.material_of(f.triangle).base_color;
      double area = 0;
      for (std::uint32_t k = b.texel_map[p].first[i]; k < b.texel_map[p].first[i + 1]; ++k)
        area += b.texel_map[p].fragments[k].area;
      absorbed += DVec3(b.radiosity.pages[p].irradiance[b.texel_map[p].texel[i]] * (Vec3(1) - albedo)) *
                  (b.radiosity.visible[p][i] * area * b.atlas.texel_m * b.atlas.texel_m);
    }
  const LightSet lights(b.scene);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(absorbed[c] / lights.power()[c], 1, 0.005) << "channel " << c;
}

TEST(Radiosity, StandardErrorIsTheSpreadOverSeeds) {
  SceneParts parts;
  parts.quad("floor", parts.diffuse(Vec3(0.5f)), {0, 0, 1}, {1, 0, 0}, {0, 0, -1});
  parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(10)), {0.3f, 0.8f, 0.3f}, {0.4f, 0, 0}, {0, 0, 0.4f});
  const Scene scene = parts.finish();
  Context context;
  AtlasOptions options;
  options.texel_m = 0.25f;
  const Atlas atlas = *build_atlas(scene, options, context);
  const auto map = *build_texel_map(atlas, context);
  const Accel accel = *Accel::build(scene);
  const LightSet lights(scene);
  double mean = 0, squares = 0, stated = 0;
  constexpr int kSeeds = 64;
  for (int seed = 0; seed < kSeeds; ++seed) {
    context.seed = static_cast<std::uint64_t>(seed);
    const Radiosity r = *bake_radiosity({{accel, lights, {}}, atlas, map}, {.samples = 16, .dilation = 2}, context);
    const double e = r.pages[0].irradiance[map[0].texel[5]].g;
    mean += e / kSeeds;
    squares += e * e / kSeeds;
    stated += std::pow(r.pages[0].standard_error[map[0].texel[5]].g, 2) / kSeeds;
  }
  const double spread = std::sqrt(squares - mean * mean);
  // Sobol points do better than the independent samples that the stated error assumes: it must never be too small.
  EXPECT_LT(spread, 1.2 * std::sqrt(stated));
  EXPECT_GT(spread, 0.05 * std::sqrt(stated));
}

TEST(Radiosity, SameBytesForOneAndTwoThreads) {
  SceneParts parts;
  parts.box("room", parts.diffuse(Vec3(0.6f)), Vec3(0), Vec3(1), true);
  parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(10)), {0.3f, 0.9f, 0.3f}, {0.4f, 0, 0}, {0, 0, 0.4f});
  const Scene scene = parts.finish();
  const FurnaceBake one = bake(scene, 0.1f, 16, 1), two = bake(scene, 0.1f, 16, 2);
  ASSERT_EQ(one.radiosity.pages.size(), two.radiosity.pages.size());
  for (std::size_t p = 0; p < one.radiosity.pages.size(); ++p) {
    const auto &a = one.radiosity.pages[p].irradiance, &b = two.radiosity.pages[p].irradiance;
    ASSERT_EQ(a.size(), b.size());
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)), 0);
  }
}

TEST(Radiosity, BuriedTexelsTakeTheirNeighboursLight) {
  SceneParts parts;
  const auto grey = parts.diffuse(Vec3(0.5f));
  parts.box("room", grey, Vec3(0), Vec3(2), true);
  parts.box("pillar", grey, {0.8f, -0.1f, 0.8f}, {1.3f, 2.1f, 1.3f});
  parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(10)), {0.2f, 1.9f, 0.2f}, {0.4f, 0, 0}, {0, 0, 0.4f});
  const FurnaceBake b = bake(parts.finish(), 0.1f, 64);
  EXPECT_GT(b.radiosity.report.buried, 20u) << "floor and ceiling under the pillar";
  for (std::size_t p = 0; p < b.texel_map.size(); ++p)
    for (std::size_t i = 0; i < b.texel_map[p].texel.size(); ++i) {
      const std::uint32_t triangle = b.texel_map[p].fragments[b.texel_map[p].first[i]].triangle;
      if (b.scene.surfaces[b.scene.triangle_surface[triangle]].name != "room") continue;
      EXPECT_GT(b.radiosity.pages[p].irradiance[b.texel_map[p].texel[i]].g, 0);
    }
}

// The share of light that an upright wall hides from a level point: distance d, height h, reaching b along it to one
// side (Howell's catalogue, B-5).
double wall_factor(double d, double h, double b) {
  const double slant = std::sqrt(d * d + h * h);
  return (std::atan(b / d) - d / slant * std::atan(b / slant)) / (2 * kPiD);
}

// Beside a one-sided wall seen from behind, nearly half of the sky is hidden and no point is buried: leaving points out
// by what their paths met would brighten the texel by 0.09 lux.
TEST(Radiosity, BackFacesDoNotBrightenVisibleTexels) {
  constexpr double kGap = 0.001, kHalf = 10, kHeight = 10, kTexel = 0.25;
  SceneParts parts;
  const auto black = parts.diffuse(Vec3(0));
  parts.quad("floor", black, {0, 0, 1}, {2, 0, 0}, {0, 0, -1});
  parts.quad("wall", black, Vec3(-kGap, 0, -kHalf), Vec3(0, 0, 2 * kHalf),
             Vec3(0, kHeight, 0));  // faces -x, away from the floor
  parts.scene().sky = Vec3(1);
  const FurnaceBake b = bake(parts.finish(), static_cast<float>(kTexel), 4096);
  int seen = 0;
  for (std::size_t p = 0; p < b.texel_map.size(); ++p)
    for (std::size_t i = 0; i < b.texel_map[p].texel.size(); ++i) {
      const std::uint32_t triangle = b.texel_map[p].fragments[b.texel_map[p].first[i]].triangle;
      if (b.scene.surfaces[b.scene.triangle_surface[triangle]].name != "floor") continue;
      const Vec3 at = point_on(b.scene, triangle, sample_texel(b.atlas, b.texel_map[p], i, Vec3(0.5f)).barycentric);
      if (at.x > kTexel) continue;
      double hidden = 0;  // mean over the texel's width; the wall reaches far beyond it along z
      for (int k = 0; k < 64; ++k) {
        const double d = kGap + kTexel * (k + 0.5) / 64;
        hidden += (wall_factor(d, kHeight, kHalf - at.z) + wall_factor(d, kHeight, kHalf + at.z)) / 64;
      }
      EXPECT_NEAR(b.radiosity.pages[p].irradiance[b.texel_map[p].texel[i]].g, kPiD * (1 - hidden), 0.02);
      ++seen;
    }
  EXPECT_EQ(seen, 4);
}

TEST(Radiosity, NoLightIsExactlyBlack) {
  SceneParts parts;
  parts.box("room", parts.diffuse(Vec3(0.5f)), Vec3(0), Vec3(1), true);
  const FurnaceBake b = bake(parts.finish(), 0.2f, 4);
  for (const LightmapPage& page : b.radiosity.pages)
    for (const Vec3& e : page.irradiance) EXPECT_EQ(e, Vec3(0));
  EXPECT_EQ(b.radiosity.report.relative_error, 0);
}

TEST(Radiosity, StopsWhenAsked) {
  SceneParts parts;
  parts.box("room", parts.diffuse(Vec3(0.5f)), Vec3(0), Vec3(1), true);
  const Scene scene = parts.finish();
  Context context;
  const Atlas atlas = *build_atlas(scene, {}, context);
  const auto map = *build_texel_map(atlas, context);
  const Accel accel = *Accel::build(scene);
  const LightSet lights(scene);
  context.stop = true;
  const auto result = bake_radiosity({{accel, lights, {}}, atlas, map}, {}, context);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kStopped);
}

TEST(Dilate, FillsOnlyWithinReach) {
  LightmapPage page{5, 1, std::vector<Vec3>(5), std::vector<Vec3>(5), std::vector<TexelState>(5)};
  page.irradiance[0] = Vec3(3);
  page.state[0] = TexelState::kValid;
  dilate(2, page);
  EXPECT_EQ(page.irradiance[2], Vec3(3));
  EXPECT_EQ(page.state[2], TexelState::kDilated);
  EXPECT_EQ(page.state[3], TexelState::kEmpty);
}

}  // namespace
}  // namespace oriel
