// The choice among many lights: an exact distribution, wherever it is asked.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "bake/trace/lights.h"
#include "bake/trace/warp.h"
#include "formats/core/color.h"
#include "tests/bake/support/chi2.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel {
namespace {

using test::independent;

Vec3 random_point(std::uint64_t i) {
  return {independent(3 * i), independent(3 * i + 1), independent(3 * i + 2)};
}

// Triangles, spots and points with powers over four decades, in a box of side `size`; some in one place.
std::vector<BoundedLight> random_lights(std::size_t count, float size) {
  std::vector<BoundedLight> lights;
  for (std::size_t i = 0; i < count; ++i) {
    BoundedLight l;
    l.lower = l.upper = i % 10 == 9 ? Vec3(0.5f * size) : size * random_point(1000 + i);
    l.axis = square_to_sphere(Vec2(random_point(5000 + i)));
    l.power = std::pow(10.0, 4.0 * independent(9000 + i));
    if (i % 3 == 0) l.upper += 0.02f * size * random_point(7000 + i), l.spread_rad = 0;
    if (i % 3 == 1) l.spread_rad = 0.6f, l.reach_rad = 0;
    lights.push_back(l);
  }
  return lights;
}

// Inside, among coinciding lights, on a light, far away.
std::vector<Vec3> places(const std::vector<BoundedLight>& lights, float size) {
  std::vector<Vec3> out = {Vec3(0.5f * size), lights[std::min<std::size_t>(2, lights.size() - 1)].lower,
                           Vec3(1e6f * size), Vec3(-size, 0, 0)};
  for (std::uint64_t i = 0; i < 20; ++i) out.push_back(size * (2.0f * random_point(i) - 0.5f));
  return out;
}

class LightTreeScale : public ::testing::TestWithParam<std::pair<std::size_t, float>> {};

TEST_P(LightTreeScale, ProbabilitiesAddUpToOne) {
  const auto [count, size] = GetParam();
  const std::vector<BoundedLight> lights = random_lights(count, size);
  const LightTree tree(lights);
  for (const Vec3& p : places(lights, size)) {
    double sum = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      const float probability = tree.probability(p, i);
      ASSERT_TRUE(probability >= 0 && probability <= 1) << probability;
      sum += probability;
    }
    EXPECT_NEAR(sum, 1, 1e-5);
    for (std::uint64_t i = 0; i < 50; ++i) {
      const LightTree::Pick pick = tree.pick(p, independent(i));
      EXPECT_NEAR(pick.probability, tree.probability(p, pick.light), 1e-5f * pick.probability);
      EXPECT_GT(pick.probability, 0);
    }
    EXPECT_GT(tree.pick(p, 1 - 0x1p-24f).probability, 0);
  }
}
INSTANTIATE_TEST_SUITE_P(Scales, LightTreeScale,
                         ::testing::Values(std::pair{1, 1.0f}, std::pair{8, 1.0f}, std::pair{9, 1.0f},
                                           std::pair{400, 1.0f}, std::pair{400, 1e-6f}, std::pair{400, 1e6f}));

double pick_chi2(const LightTree& tree, std::size_t count, const Vec3& p, double exponent) {
  constexpr std::uint32_t kSamples = 400000;
  std::vector<double> found(count);
  for (std::uint32_t i = 0; i < kSamples; ++i) found[tree.pick(p, independent(77 + i)).light] += 1;
  double chi2 = 0;
  int cells = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double expected = kSamples * std::pow(tree.probability(p, i), exponent);
    if (expected < 10) continue;
    chi2 += (found[i] - expected) * (found[i] - expected) / expected;
    ++cells;
  }
  return (chi2 - cells) / std::sqrt(2.0 * cells);
}

TEST(LightTree, PicksAsItsProbabilitiesSay) {
  const std::vector<BoundedLight> lights = random_lights(100, 1);
  const LightTree tree(lights);
  for (const Vec3& p : {Vec3(0.3f, 0.6f, 0.2f), Vec3(-1, 2, 0.5f)}) {
    EXPECT_LT(pick_chi2(tree, 100, p, 1), 5);
    EXPECT_GT(pick_chi2(tree, 100, p, 1.1), 20) << "the checker must see wrong probabilities";
  }
}

// A candle beside a window, wherever it is asked: the window may be hidden from there.
TEST(LightTree, NoneOfAFewIsLeftToLuck) {
  for (const std::size_t count : {2u, 12u, 64u}) {
    std::vector<BoundedLight> lights = random_lights(count, 1);
    lights[1].power = 1e9 * lights[0].power;
    const LightTree tree(lights);
    for (std::uint64_t k = 0; k < 20; ++k)
      for (std::uint32_t i = 0; i < count; ++i)
        EXPECT_GE(tree.probability(random_point(k), i), 0.99 * LightTree::kEven / static_cast<double>(count));
  }
}

// What shines on a point must have a chance there, or light would be lost.
TEST(LightTree, NoLightThatShinesIsLeftOut) {
  const std::vector<BoundedLight> lights = random_lights(300, 1);
  const LightTree tree(lights);
  int shining = 0;
  for (std::uint64_t k = 0; k < 200; ++k) {
    const Vec3 p = 3.0f * random_point(20000 + k) - 1.0f;
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
      const BoundedLight& l = lights[i];
      const Vec3 from = l.lower + random_point(30000 + k) * (l.upper - l.lower);
      const float angle = std::acos(std::clamp(glm::dot(glm::normalize(p - from), l.axis), -1.0f, 1.0f));
      if (angle > l.spread_rad + l.reach_rad - 1e-3f) continue;
      ++shining;
      ASSERT_GT(tree.probability(p, i), 0) << i;
    }
  }
  EXPECT_GT(shining, 10000);
}

// 20 rooms in a row, 20 lamps in each. Relative error of the direct light at points of the floors, 16 samples each.
struct RoomsError {
  double tree = 0, power = 0;
};
RoomsError error_in_rooms() {
  test::SceneParts parts;
  const std::uint32_t wall = parts.diffuse(Vec3(0.5f));
  for (int room = 0; room < 20; ++room) {
    const float x = 5.0f * static_cast<float>(room);
    parts.box(fmt::format("room {}", room), wall, {x, 0, 0}, {x + 4.9f, 3, 4}, true);
    for (int lamp = 0; lamp < 20; ++lamp) {
      Light light;
      light.position = {x + 0.5f + 0.95f * static_cast<float>(lamp % 5), 2.8f,
                        0.5f + 0.95f * static_cast<float>(lamp / 5)};
      light.intensity = Vec3(50 + 100 * independent(static_cast<std::uint64_t>(20 * room + lamp)));
      parts.scene().lights.push_back(light);
    }
  }
  const Scene scene = parts.finish();
  const Accel accel = *Accel::build(scene);
  const LightSet lights(scene);
  std::vector<double> cdf;
  for (const Light& light : scene.lights) cdf.push_back((cdf.empty() ? 0 : cdf.back()) + luminance(light.intensity));

  const auto irradiance = [&](const LightSample& s, const Vec3& p) {
    if (!(s.direction.y > 0) || s.estimate.g <= 0) return 0.0;
    return static_cast<double>(s.estimate.g * s.direction.y * accel.transmittance({p, s.direction, s.distance}).g);
  };
  RoomsError sum;
  constexpr int kPoints = 400, kSamples = 16;
  for (std::uint32_t k = 0; k < kPoints; ++k) {
    const Vec3 p(5.0f * static_cast<float>(k % 20) + 0.1f + 4.7f * independent(500 + k), 1e-4f,
                 0.1f + 3.8f * independent(900 + k));
    double truth = 0, by_tree = 0, by_power = 0;
    for (std::uint32_t i = 0; i < scene.lights.size(); ++i) truth += irradiance(lights.sample_light(i, p, Vec2(0)), p);
    for (std::uint32_t i = 0; i < kSamples; ++i) {
      Sampler sampler(1, k, i);
      const float u = sampler.next1();
      by_tree += irradiance(lights.sample(p, u, sampler.next2()), p);
      const auto at =
          std::min<std::size_t>(std::upper_bound(cdf.begin(), cdf.end(), u * cdf.back()) - cdf.begin(), cdf.size() - 1);
      const double probability = (cdf[at] - (at > 0 ? cdf[at - 1] : 0)) / cdf.back();
      by_power += irradiance(lights.sample_light(static_cast<std::uint32_t>(at), p, Vec2(0)), p) / probability;
    }
    sum.tree += std::pow(by_tree / kSamples / truth - 1, 2) / kPoints;
    sum.power += std::pow(by_power / kSamples / truth - 1, 2) / kPoints;
  }
  return {std::sqrt(sum.tree), std::sqrt(sum.power)};
}

TEST(LightTree, FindsTheLampsOfTheRoom) {
  const RoomsError error = error_in_rooms();
  std::printf("400 lamps in 20 rooms, 16 samples: relative error %.3f by the tree, %.3f by power\n", error.tree,
              error.power);
  EXPECT_LT(error.tree, error.power / 4);
}

}  // namespace
}  // namespace oriel
