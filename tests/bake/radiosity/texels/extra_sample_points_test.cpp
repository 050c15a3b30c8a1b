// Points of texels beyond those that are kept.
#include "bake/radiosity/texels/extra_sample_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "bake/radiosity/gather/gather.h"
#include "tests/bake/radiosity/listed.h"

namespace oriel::test {
namespace {

// A floor of one texel, of which all but the strip x > 0.8 m lies under a block that stands in it.
Scene strip() {
  SceneParts parts;
  parts.quad("floor", parts.diffuse(Vec3(0.5f)), {0, 0, 0}, {0, 0, 1}, {1, 0, 0});
  parts.box("block", parts.diffuse(Vec3(0.5f)), {-1, -1, -1}, {0.8f, 1, 2});
  return parts.finish();
}

TEST(ExtraSamplePoints, LieInThePartThatSeesLight) {
  const Listed listed(strip(), 1);
  ASSERT_FALSE(listed.floor.empty());
  const std::uint32_t floor = listed.floor.back();
  ASSERT_NEAR(listed.texels.visible[floor], 0.2, 0.08);
  const Transport transport = listed.transport();
  const ExtraSamplePoints sample_points = listed.sample_points(transport);
  constexpr std::uint32_t kPoints = 512;
  for (int half = 0; half < kHalves; ++half) {
    const std::uint32_t kept = listed.texels.sample_point_count(floor, half);
    ASSERT_LT(kept, kPoints / 4);
    std::set<std::pair<float, float>> points;
    double x = 0, z = 0;
    std::uint64_t rays = 0;
    for (std::uint32_t k = 0; k < kPoints; ++k) {
      const SamplePoint point = sample_points.at(floor, half, k, rays);
      if (k < kept) {
        EXPECT_EQ(point.origin, listed.texels.sample_point(floor, half, k).origin);
      }
      EXPECT_GT(point.origin.x, 0.8f);
      points.emplace(point.origin.x, point.origin.z);
      x += point.origin.x / kPoints, z += point.origin.z / kPoints;
    }
    EXPECT_GT(points.size(), (kPoints - 3 * kept) * 9 / 10) << "kept ones serve four times, and where tries find none";
    EXPECT_NEAR(x, 0.9, 4 * 0.2 / std::sqrt(12.0 * kPoints));
    EXPECT_NEAR(z, 0.5, 4 * 1.0 / std::sqrt(12.0 * kPoints));
    EXPECT_GT(rays, kPoints - kept);
  }
}

// A floor of one texel, of which all but the strip x > 0.8 m lies inside a hollow plinth under a board: from in there
// rays meet the board's front, not backs.
Scene hollow_plinth() {
  SceneParts parts;
  const auto paint = parts.diffuse(Vec3(0.5f));
  parts.quad("floor", paint, {0, 0, 0}, {0, 0, 1}, {1, 0, 0});
  parts.box("board", paint, {-2, 0.3f, -2}, {0.85f, 0.5f, 3});
  parts.quad("plinth, front", paint, {0.8f, 0, -2}, {0, 0.3f, 0}, {0, 0, 5});
  return parts.finish();
}

TEST(TexelPart, IsTheSideThatEyesSee) {
  Listed listed(hollow_plinth(), 1);
  const std::uint32_t floor = listed.floor.back();
  const std::vector<Vec3> eyes = {{4, 1.6f, 0.5f}, {5, 1.6f, 1}};
  const Texels seen = *list_texels({listed.transport(), listed.atlas, listed.map}, listed.context, {eyes});
  ASSERT_GT(listed.texels.visible[floor], 0);
  ASSERT_GT(seen.visible[floor], 0);
  for (const SamplePoint& point : listed.texels.sample_points[floor]) EXPECT_LT(point.origin.x, 0.8f) << "most of it";
  for (const SamplePoint& point : seen.sample_points[floor]) EXPECT_GT(point.origin.x, 0.8f) << "what is seen of it";
  EXPECT_NEAR(seen.visible[floor], 0.2, 0.1);
}

constexpr double kHeight = 1.05, kHole = 0.15;  // m; of the hole half its side

// A floor of 1 m, 1.05 m under a black ceiling with a hole of 0.3 m through which a sky of 1 cd/m² shines: light that
// varies over a texel of which nothing is near.
Scene under_a_hole() {
  constexpr float kWide = 2, kTop = kHeight + 1e-4f, kLow = kHeight, kSmall = kHole;
  SceneParts parts;
  const auto black = parts.diffuse(Vec3(0));
  parts.quad("floor", black, {-0.5f, 0, 0.5f}, {1, 0, 0}, {0, 0, -1});
  parts.box("ceiling", black, {-kWide, kLow, -kWide}, {kWide, kTop, -kSmall});
  parts.box("ceiling", black, {-kWide, kLow, kSmall}, {kWide, kTop, kWide});
  parts.box("ceiling", black, {-kWide, kLow, -kSmall}, {-kSmall, kTop, kSmall});
  parts.box("ceiling", black, {kSmall, kLow, -kSmall}, {kWide, kTop, kSmall});
  parts.box("wall", black, {-kWide - 1, -1, -kWide - 1}, {-kWide, kTop, kWide + 1});
  parts.box("wall", black, {kWide, -1, -kWide - 1}, {kWide + 1, kTop, kWide + 1});
  parts.box("wall", black, {-kWide, -1, -kWide - 1}, {kWide, kTop, -kWide});
  parts.box("wall", black, {-kWide, -1, kWide}, {kWide, kTop, kWide + 1});
  Scene scene = parts.finish();
  scene.sky = Vec3(1);
  return scene;
}

// ∫ cos⁴ / h² over the hole, mean over the floor; lux.
double under_the_hole() {
  constexpr int kSteps = 32;
  double sum = 0;
  const auto at = [](int n, double half) { return half * ((2 * n + 1.0) / kSteps - 1); };
  for (int a = 0; a < kSteps; ++a)
    for (int b = 0; b < kSteps; ++b)
      for (int c = 0; c < kSteps; ++c)
        for (int d = 0; d < kSteps; ++d) {
          const double x = at(a, 0.5) - at(b, kHole), z = at(c, 0.5) - at(d, kHole);
          sum += kHeight * kHeight / std::pow(x * x + z * z + kHeight * kHeight, 2);
        }
  return 4 * kHole * kHole * sum / std::pow(kSteps, 4);
}

TEST(ExtraSamplePoints, AreDrawnWhereRaysAreMany) {
  constexpr std::uint32_t kRays = 1u << 18u;
  const double expected = under_the_hole();
  double squares = 0;
  constexpr std::uint64_t kSeeds = 8;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    Listed listed(under_a_hole(), 1, seed);
    const Transport transport = listed.transport();
    const CacheQuery query(transport, listed.texels, true, seed);
    const std::size_t n = listed.texels.count();
    const std::vector<Vec3> dark(n);
    const CachedLight cached{dark, std::vector<CachedTexel>(n)};
    HalfSums sums(n, false);
    ASSERT_TRUE(
        (FinalGather{listed.sample_points(transport), query, cached}.run(listed.floor, kRays, listed.context, sums)));
    double light = 0, area = 0;
    for (const std::uint32_t i : listed.floor) {
      ASSERT_FALSE(listed.texels.occlusion_heavy[i]);
      light += double{listed.texels.area_m2[i]} * sums.mean(i).g, area += listed.texels.area_m2[i];
    }
    const double off = light / area / expected - 1;
    squares += off * off / kSeeds;
  }
  // A hit is worth π lux, so that the rays' own noise is
  const double noise = std::sqrt(kPi / (expected * kHalves * kRays));
  EXPECT_LT(std::sqrt(squares), 2 * noise);
}

}  // namespace
}  // namespace oriel::test
