// What the filter does to direct light: noise of penumbrae goes, all that is no noise stays.
#include "bake/radiosity/estimators/filter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bake/radiosity/estimators/diffusion.h"
#include "bake/radiosity/estimators/light_component.h"
#include "formats/core/color.h"
#include "tests/bake/radiosity/listed.h"

namespace oriel::test {
namespace {

// A floor of 3 m under a lamp, a board above it that throws a wide penumbra, and a wall that stands on it: its shadow
// is sharp where they meet.
Scene shadows(const Vec3& wall_moves = Vec3(0)) {
  SceneParts parts;
  const auto matt = parts.diffuse(Vec3(0.5f));
  parts.quad("floor", matt, {0, 0, 0}, {0, 0, 3}, {3, 0, 0});
  parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(100)), {1, 2.5f, 1}, {1, 0, 0}, {0, 0, 1});
  parts.box("board", matt, {0.2f, 1.2f, 0.4f}, {1.2f, 1.25f, 1.6f});
  parts.box("wall", matt, Vec3(2.2f, 0, 0.5f) + wall_moves, Vec3(2.3f, 0.3f, 2.5f) + wall_moves);
  return parts.finish();
}

struct Shadows {
  Listed listed{shadows(), 0.05f};
  const Transport transport = listed.transport();
  const ExtraSamplePoints sample_points = listed.sample_points(transport);
  const TexelGraph graph = *find_neighbours(transport, listed.texels, listed.context);

  DirectSums direct(std::uint32_t per_half, std::uint64_t seed) {
    DirectSums sums(listed.texels.count(), false);
    const DirectLight light(transport, listed.texels, sample_points, seed);
    EXPECT_TRUE(light.estimate(listed.floor, per_half, listed.context, sums));
    return sums;
  }
};

// A file's own coordinates spread a wall of 9 m x 3 m over a square: three texels high are one wide.
TEST(Filter, SeesAllNeighboursOfStretchedTexels) {
  SceneParts parts;
  parts.quad("wall", parts.diffuse(Vec3(0.5f)), {0, 0, 0}, {9, 0, 0}, {0, 3, 0});
  AtlasOptions own;
  own.source = AtlasOptions::Source::kUv1;
  Listed listed{parts.finish(), 0.1f, 1, own};
  const TexelGraph graph = *find_neighbours(listed.transport(), listed.texels, listed.context);
  double inner = 0, full = 0;
  for (std::uint32_t i = 0; i < graph.count.size(); ++i) {
    const Vec3& at = listed.texels.sample_points[i][0].origin;
    if (std::min({at.x, 9 - at.x, at.y, 3 - at.y}) < 0.5f) continue;
    ++inner, full += graph.count[i] == kMaxNeighbours ? 1 : 0;
  }
  EXPECT_GT(inner, 1000);
  EXPECT_GT(full, 0.99 * inner) << "few diagonals are too long: sample points are random";
}

TEST(Filter, TakesNoiseFromPenumbraeAndLeavesShadowsEdges) {
  Shadows s;
  const Texels& texels = s.listed.texels;
  const std::vector<Vec3> truth = s.direct(1024, 99).value;
  const DirectSums sums = s.direct(4, 1);
  const std::vector<Vec3> gathered(texels.count(), Vec3(30));
  const Estimate smooth = filter(texels, s.graph, halves_of(sums, gathered), {.scales = 1}, s.listed.context);
  double noise = 0, left = 0, all = 0, stated = 0, sharp = 0, stated_sharp = 0, penumbra = 0, exact = 0, mixed = 0;
  for (const std::uint32_t i : s.listed.floor) {
    if (texels.visible[i] < 1) continue;
    const double before = sums.value[i].g - truth[i].g, after = smooth.value[i].g - truth[i].g;
    const bool soft = texels.sample_point(i, 0, 0).origin.x < 1.9f;
    (soft ? all : sharp) += after * after, (soft ? stated : stated_sharp) += smooth.variance[i].g;
    if (sums.variance[i].g > 0) {
      ++penumbra, noise += before * before, left += after * after;
    } else {  // wholly lit or dark by these samples
      const double added = std::fabs(after) - std::fabs(before);
      const double light = 1e-3 * truth[i].g, error = std::sqrt(double{smooth.variance[i].g});
      exact += 1, mixed += added > std::max(light, 3 * error) ? 1 : 0;
    }
  }
  ASSERT_GT(penumbra, 300);
  EXPECT_LT(std::sqrt(left / noise), 0.6) << "half the noise at least";
  EXPECT_GT(std::sqrt(left / noise), 0.05) << "no noise: the test shows nothing";
  EXPECT_GT(std::sqrt(stated / all), 0.8);
  EXPECT_LT(std::sqrt(stated / all), 2);
  EXPECT_GT(std::sqrt(stated_sharp / sharp), 0.8) << "beside the wall";
  EXPECT_LT(mixed / exact, 0.01) << "light that was exact has been mixed with what is not, and it is not stated";
  EXPECT_LT(std::fabs(smooth.energy_drift), 5e-4);
}

// Even light, a twelfth of whose samples are so bright that they bring half of it: by chance some texels have two or
// three of these, in both halves.
TEST(Filter, LeavesNoDots) {
  Shadows s;
  const Texels& texels = s.listed.texels;
  HalfSums sums(texels.count(), false);
  constexpr std::uint32_t kSamples = 4;
  for (const std::uint32_t i : s.listed.floor) {
    sums.samples[i] = kSamples;
    for (int h = 0; h < kHalves; ++h)
      for (std::uint32_t k = 0; k < kSamples; ++k)
        sums.sum[h][i] += Vec3(mix64((i * 2 + static_cast<std::uint32_t>(h)) * kSamples + k) % 12 == 0 ? 650 : 50);
  }
  const Estimate smooth = filter(texels, s.graph, halves_of(sums, s.listed.context), {}, s.listed.context);
  std::size_t dots = 0, open = 0, dots_at_ends = 0, at_ends = 0;
  for (const std::uint32_t i : s.listed.floor) {
    if (texels.visible[i] < 1 || texels.occlusion_heavy[i]) continue;
    const bool end = s.graph.of(i).size() < kMaxNeighbours;
    const bool dot = std::fabs(smooth.value[i].g - 100) > 30;
    (end ? at_ends : open) += 1, (end ? dots_at_ends : dots) += dot ? 1 : 0;
  }
  ASSERT_GT(open, 1000);
  ASSERT_GT(at_ends, 100);
  EXPECT_LT(dots, open / 300);
  EXPECT_LT(dots_at_ends, at_ends / 16) << "where few neighbours smooth the guide";
  EXPECT_LT(std::fabs(smooth.energy_drift), 5e-4);
}

// At the foot of a wall a ray that met something bright brings one half of one texel as much light again and more. What
// both halves show there is light.
TEST(Filter, SmoothsTexelsAtTheFootOfAWall) {
  Shadows s{.listed = {shadows({-0.02f, -0.1f, 0.02f}), 0.05f}};
  const Texels& texels = s.listed.texels;
  std::vector<std::uint32_t> foot;
  for (const std::uint32_t i : s.listed.floor)
    if (texels.visible[i] > 0 && texels.visible[i] < 1 && !texels.meets_gap[i]) foot.push_back(i);
  ASSERT_GT(foot.size(), 40u);
  for (const bool in_both : {false, true}) {
    HalfSums sums(texels.count(), false);
    for (const std::uint32_t i : s.listed.floor) {
      sums.samples[i] = 1;
      for (int h = 0; h < kHalves; ++h)
        sums.sum[h][i] = Vec3(99 + static_cast<float>(mix64(i * 2 + static_cast<std::uint32_t>(h)) % 3));
    }
    for (std::size_t k = 0; k < foot.size(); k += in_both ? 1 : 10)
      for (int h = 0; h < (in_both ? 2 : 1); ++h) sums.sum[h][foot[k]] *= 3;
    const Estimate smooth = filter(texels, s.graph, halves_of(sums, s.listed.context), {}, s.listed.context);
    for (const std::uint32_t i : foot) {
      if (in_both)
        EXPECT_GT(smooth.value[i].g, 250) << i;
      else
        EXPECT_LT(smooth.value[i].g, 130) << i << ", of " << sums.mean(i).g;
    }
    EXPECT_LT(std::fabs(smooth.energy_drift), 5e-4);
  }
}

// A flat lamp's body hangs 2 cm under a ceiling. Its inside faces down, too, and may hold any light.
TEST(Filter, TheInsideOfALampIsNoPartOfTheCeiling) {
  SceneParts parts;
  const auto matt = parts.diffuse(Vec3(0.5f));
  parts.quad("ceiling", matt, {0, 2.6f, 0}, {3, 0, 0}, {0, 0, 3});
  parts.quad("inside", matt, {1, 2.58f, 1}, {0.9f, 0, 0}, {0, 0, 0.9f});
  parts.quad("bottom", matt, {1, 2.56f, 1}, {0.9f, 0, 0}, {0, 0, 0.9f});
  for (const float at : {1.0f, 1.9f}) {
    parts.quad("side", matt, {at, 2.56f, 1}, {0, 0.02f, 0}, {0, 0, 0.9f});
    parts.quad("side", matt, {1, 2.56f, at}, {0, 0.02f, 0}, {0.9f, 0, 0});
  }
  Listed listed{parts.finish(), 0.4f};
  const Transport transport = listed.transport();
  const TexelGraph graph = *find_neighbours(transport, listed.texels, listed.context);
  std::size_t seen = 0, inside = 0;
  for (const std::uint32_t i : listed.floor) {
    seen += graph.count[i];
    for (const std::uint32_t j : graph.of(i))
      inside += std::fabs(listed.texels.sample_point(j, 0, 0).origin.y - 2.58f) < 0.01f;
  }
  EXPECT_GT(seen, 100u);
  EXPECT_EQ(inside, 0u);
}

// What light tells of a texel alone parts it from its neighbours at a contact, and everywhere only where light may
// step.
TEST(Filter, LightFromAllAroundStepsAtContactsAlone) {
  Shadows s;
  const Texels& texels = s.listed.texels;
  std::vector<Vec3> raw(texels.count(), Vec3(100));
  std::vector<std::uint32_t> bright;
  for (const std::uint32_t i : s.listed.floor)
    if (texels.x[i] % 2 == 0 && texels.y[i] % 2 == 0 && texels.visible[i] >= 1) raw[i] = Vec3(300), bright.push_back(i);
  const std::vector<Vec3> even(texels.count(), Vec3(100)), variance(texels.count(), Vec3(1));
  std::size_t open = 0, contacts = 0;
  for (const bool steps : {false, true}) {
    const Conductance c = conductances(texels, s.graph, {even, variance}, {raw, variance, 1, steps}, s.listed.context);
    for (const std::uint32_t i : bright)
      for (std::size_t k = 0; k < s.graph.of(i).size(); ++k) {
        const std::uint32_t j = s.graph.of(i)[k];
        if (texels.visible[j] < 1) continue;
        const bool contact = texels.occlusion_heavy[i] || texels.occlusion_heavy[j];
        ++(contact ? contacts : open);
        EXPECT_EQ(c[i][k] > 0.01f, !contact && !steps) << i << " and " << j;
      }
  }
  EXPECT_GT(open, 100);
  EXPECT_GT(contacts, 10);
}

// Refinement goes on where an error falls by more for its rays.
TEST(LightComponent, PaysWhereItsErrorIsGreaterForItsRays) {
  const std::vector<std::uint32_t> samples = {4, 4, 8}, all = {0, 1, 2};
  LightComponent dear{
      .samples = samples, .max_samples = 8, .gain = 0.5, .rays = 1000, .squares = {0.01f, 0.02f, 0.03f}};
  LightComponent cheap = dear;
  cheap.rays = 100;
  const std::vector<float> importance = {0.125f, 0.125f, 0.25f, 0.5f};
  dear.measure(all, importance), cheap.measure(all, importance);
  EXPECT_NEAR(dear.mean, 0.12, 1e-7);
  EXPECT_TRUE(cheap.pays_more_than(dear));
  EXPECT_FALSE(dear.pays_more_than(cheap));
  EXPECT_NEAR(cheap.refinable(), 0.06, 1e-7) << "texel 2 has all its samples,";
  EXPECT_NEAR(cheap.refinable_rays, 50, 1e-9) << "half of all";
}

}  // namespace
}  // namespace oriel::test
