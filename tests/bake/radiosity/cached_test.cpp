// The cached estimator against closed forms, and against unbiased paths where there is no closed form.
#include <gtest/gtest.h>

#include "tests/bake/radiosity/baked.h"

namespace oriel {
namespace {

using test::bake;
using test::Baked;
using test::SceneParts;

RadiosityOptions cached(std::uint32_t samples) {
  RadiosityOptions o;
  o.estimator = Estimator::kCached;
  o.samples = samples;
  o.dilation = 0;
  return o;
}

RadiosityOptions to_error(double error) {
  RadiosityOptions o = cached(4096);
  o.error = error;
  return o;
}

// Every texel of a closed box or sphere whose walls all emit and reflect alike: E = πL / (1 - ρ).
class CachedFurnace : public testing::TestWithParam<std::tuple<bool, float>> {};

TEST_P(CachedFurnace, EveryTexelIsTheSeries) {
  const auto [sphere, albedo] = GetParam();
  SceneParts parts;
  const auto wall = parts.diffuse(Vec3(albedo), Vec3(1));
  if (sphere)
    parts.sphere("sphere", wall, Vec3(0), 1, 2, true);
  else
    parts.box("box", wall, Vec3(-1), Vec3(1), true);
  const Baked b = bake(parts.finish(), 0.15f, cached(64));
  double worst = 0, sum = 0;
  int count = 0;
  b.each_texel([&](const LightmapPage& page, std::uint32_t t, std::uint32_t) {
    const double e = page.irradiance[t].g * (1 - albedo) / kPiD;
    const double error = page.standard_error[t].g * (1 - albedo) / kPiD;
    worst = std::max(worst, std::abs(e - 1) - 5 * error);
    sum += e, ++count;
  });
  EXPECT_NEAR(sum / count, 1, 1e-3);
  EXPECT_LT(worst, 1e-3);  // beyond five standard errors
  EXPECT_EQ(b.radiosity.report.buried, 0u);
}
INSTANTIATE_TEST_SUITE_P(Shapes, CachedFurnace,
                         testing::Combine(testing::Bool(), testing::Values(0.0f, 0.5f, 0.9f, 0.99f)));

enum class Feature { kMatt, kGlossyFloor, kMirror, kGlass, kCutOut, kSphere, kPoint, kSky, kDielectric, kManyLamps };

void add_features(SceneParts& parts, Feature feature) {
  const auto white = parts.diffuse(Vec3(0.7f));
  SceneMaterial special;
  special.base_color = Vec3(0.6f, 0.4f, 0.3f);
  special.metallic = 0;
  if (feature == Feature::kMirror) special.metallic = 1, special.roughness = 0, special.base_color = Vec3(0.9f);
  if (feature == Feature::kGlossyFloor) special.metallic = 1, special.roughness = 0.4f;
  if (feature == Feature::kDielectric) special.roughness = 0.3f;
  if (feature == Feature::kGlass) special.transmission = 0.8f, special.double_sided = true;
  if (feature == Feature::kCutOut) special.alpha_mode = AlphaMode::kBlend, special.alpha = 0.5f;
  const auto other = feature == Feature::kMatt ? white : parts.add(special);
  const bool floor = feature == Feature::kGlossyFloor || feature == Feature::kMirror || feature == Feature::kDielectric;
  parts.quad("floor", floor ? other : white, {0, 0, 2}, {2, 0, 0}, {0, 0, -2});
  if (feature != Feature::kSky) parts.quad("ceiling", white, {0, 2, 0}, {2, 0, 0}, {0, 0, 2});
  parts.quad("back", white, {0, 0, 0}, {2, 0, 0}, {0, 2, 0});
  parts.quad("left", parts.diffuse({0.6f, 0.05f, 0.05f}), {0, 0, 2}, {0, 0, -2}, {0, 2, 0});
  parts.quad("right", parts.diffuse({0.1f, 0.5f, 0.1f}), {2, 0, 0}, {0, 0, 2}, {0, 2, 0});
  if (feature == Feature::kGlass || feature == Feature::kCutOut)
    parts.quad("pane", other, {0.5f, 1.2f, 0.3f}, {1, 0, 0}, {0, 0, 1.2f});
  else if (feature == Feature::kSphere)
    parts.sphere("ball", white, Vec3(1, 0.5f, 1), 0.4f, 2);
  else
    parts.box("block", white, {0.5f, 0, 0.4f}, {1.1f, 1.1f, 1});
  if (feature == Feature::kPoint)
    parts.scene().lights.push_back({"lamp", LightType::kPoint, Vec3(1, 1.8f, 1.3f), Vec3(0, -1, 0), Vec3(3)});
  else if (feature == Feature::kSky)
    parts.scene().sky = Vec3(2, 2.5f, 3);
  else if (feature == Feature::kManyLamps)
    parts.sphere("lamp", parts.diffuse(Vec3(0), Vec3(60, 50, 40)), Vec3(1, 1.7f, 1.2f), 0.1f, 2);
  else
    parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(10, 7, 4)), {0.7f, 1.99f, 0.7f}, {0.5f, 0, 0}, {0, 0, 0.5f});
}

// Mean of the light by surface, against unbiased paths: within 0.3 %, four standard errors of independent texels and
// one of texels that share their directions.
class CachedAgrees : public testing::TestWithParam<Feature> {};

TEST_P(CachedAgrees, SurfaceMeansEqualUnbiasedPaths) {
  SceneParts parts;
  add_features(parts, GetParam());
  const Scene scene = parts.finish();
  RadiosityOptions paths;
  paths.samples = 512;
  paths.dilation = 0;
  const Baked truth = bake(scene, 0.12f, paths), b = bake(scene, 0.12f, to_error(0.01));
  struct Sum {
    double difference = 0, mean = 0, noise = 0, shared = 0;
  };
  std::vector<Sum> sums(scene.surfaces.size());
  truth.each_texel([&](const LightmapPage& page, std::uint32_t t, std::uint32_t triangle) {
    const std::size_t p = static_cast<std::size_t>(&page - truth.radiosity.pages.data());
    const LightmapPage& other = b.radiosity.pages[p];
    if (other.state[t] != TexelState::kValid) return;
    Sum& sum = sums[scene.triangle_surface[triangle]];
    sum.mean += page.irradiance[t].g;
    sum.difference += other.irradiance[t].g - page.irradiance[t].g;
    sum.noise += std::pow(page.standard_error[t].g, 2) + std::pow(other.standard_error[t].g, 2);
    sum.shared += other.standard_error[t].g;
  });
  for (std::size_t s = 0; s < sums.size(); ++s) {
    if (sums[s].mean <= 0) continue;
    EXPECT_NEAR(sums[s].difference, 0, 0.003 * sums[s].mean + 4 * std::sqrt(sums[s].noise) + sums[s].shared)
        << scene.surfaces[s].name << ", of " << sums[s].mean;
  }
}
INSTANTIATE_TEST_SUITE_P(Features, CachedAgrees,
                         testing::Values(Feature::kMatt, Feature::kGlossyFloor, Feature::kMirror, Feature::kGlass,
                                         Feature::kCutOut, Feature::kSphere, Feature::kPoint, Feature::kSky,
                                         Feature::kDielectric, Feature::kManyLamps));

TEST(Cached, OneAndTwoThreadsGiveTheSameBytes) {
  SceneParts parts;
  add_features(parts, Feature::kDielectric);
  const Scene scene = parts.finish();
  const Baked a = bake(scene, 0.15f, to_error(0.05), 1), b = bake(scene, 0.15f, to_error(0.05), 2);
  EXPECT_EQ(a.radiosity.pages[0].irradiance, b.radiosity.pages[0].irradiance);
  EXPECT_EQ(a.radiosity.pages[0].standard_error, b.radiosity.pages[0].standard_error);
}

}  // namespace
}  // namespace oriel
