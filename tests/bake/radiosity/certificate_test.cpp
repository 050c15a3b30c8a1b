// What held-out texels tell: the error that is there, whatever the bake says of itself.
#include "bake/radiosity/certificate.h"

#include <gtest/gtest.h>

#include "bake/trace/sampler.h"

#include "tests/bake/radiosity/baked.h"
#include "tests/bake/radiosity/rooms.h"

namespace oriel {
namespace {

using test::Baked;
using test::SceneParts;

constexpr std::uint64_t kManyRays = 4'000'000;

Baked room(double error, double verify = 0) {
  return test::bake(test::room(test::Feature::kMatt), 0.15f,
                    {.estimator = Estimator::kCached, .samples = 4096, .error = error, .verify = verify});
}

Certificate certificate_of(const Baked& b, double asked, std::uint64_t rays, int threads = 0) {
  Context context;
  context.threads = threads;
  const Accel accel = *Accel::build(b.scene);
  const LightSet lights(b.scene);
  return *certify({accel, lights, {}}, b.atlas, b.texel_map, b.radiosity, asked, rays, context);
}

// Multiplies every second texel by 1 + off, the others by 1 - off.
void spoil(Baked& b, float off) {
  for (LightmapPage& page : b.radiosity.pages)
    for (std::size_t i = 0; i < page.irradiance.size(); ++i)
      page.irradiance[i] *= 1 + ((i + i / page.width) % 2 == 0 ? off : -off);
}

TEST(HeldOut, TellTheErrorThatIsThere) {
  Baked b = room(0.02);
  const Certificate good = certificate_of(b, 0.02, kManyRays);
  EXPECT_GT(good.texels, 64u);
  EXPECT_LE(good.error_low, 0.02 * 1.2);
  EXPECT_LT(good.error_high, 0.04);
  spoil(b, 0.1f);
  const Certificate spoilt = certificate_of(b, 0.1, kManyRays);
  const double expected = std::sqrt(0.1 * 0.1 + good.relative_error * good.relative_error);
  EXPECT_LE(spoilt.error_low, expected) << "the interval holds it";
  EXPECT_GE(spoilt.error_high, expected);
  EXPECT_GT(spoilt.error_low, 0.05) << "and says that it is not what the bake states, "
                                    << b.radiosity.report.relative_error;
}

// Every texel of which less than half has a surface is made twice too bright.
TEST(HeldOut, WeighTexelsByWhatIsSeenOfThem) {
  Baked b = room(0.02);
  constexpr double kOff = 1;
  double slivers = 0, seen = 0;
  for (std::size_t p = 0; p < b.texel_map.size(); ++p)
    for (std::size_t i = 0; i < b.texel_map[p].texel.size(); ++i) {
      const double share = seen_share(b.texel_map, b.radiosity, p, i);
      seen += share;
      if (share > 0.5) continue;
      slivers += share;
      b.radiosity.pages[p].irradiance[b.texel_map[p].texel[i]] *= static_cast<float>(1 + kOff);
    }
  ASSERT_GT(slivers, 0);
  const double expected = kOff / (1 + kOff) * std::sqrt(slivers / seen);  // relative to the brighter of the two
  const Certificate c = certificate_of(b, expected, 4 * kManyRays);
  EXPECT_GE(c.error_high, expected);
  EXPECT_LE(c.error_low, std::hypot(expected, 0.025));
  EXPECT_LT(c.error_high - c.error_low, expected) << "known well enough to say";
}

// Furniture of the size of its texels: what rays look up is not what is there, and more rays would not mend that.
TEST(HeldOut, TellOfLookUpsThatAreThenFollowed) {
  constexpr double kAsked = 0.015;
  const auto bake_room = [](double verify, int threads) {
    return test::bake(test::room(test::Feature::kMatt), 0.5f,
                      {.estimator = Estimator::kCached, .samples = 4096, .error = kAsked, .verify = verify}, threads);
  };
  const Baked once = bake_room(0, 0), refined = bake_room(2, 1), same = bake_room(2, 2);
  const Certificate before = certificate_of(once, kAsked, kManyRays), &after = refined.radiosity.report.certificate;
  EXPECT_EQ(refined.radiosity.report.refinements, 1);
  EXPECT_LT(after.relative_error, before.relative_error);
  EXPECT_LE(after.error_low, kAsked);
  EXPECT_EQ(refined.radiosity.pages[0].irradiance, same.radiosity.pages[0].irradiance);
}

TEST(HeldOut, FewRaysGiveAWiderInterval) {
  Baked b = room(0.05);
  spoil(b, 0.1f);
  const Certificate few = certificate_of(b, 0.02, 1), many = certificate_of(b, 0.02, kManyRays);
  EXPECT_GT(few.texels, 0u) << "a first batch there is";
  EXPECT_LT(few.rays, many.rays / 10);
  EXPECT_GT(few.error_high - few.error_low, many.error_high - many.error_low);
}

TEST(HeldOut, AreTheSameForAnyThreads) {
  const Baked b = room(0.05);
  const Certificate one = certificate_of(b, 0.05, 500'000, 1), two = certificate_of(b, 0.05, 500'000, 2);
  EXPECT_EQ(one.relative_error, two.relative_error);
  EXPECT_EQ(one.texels, two.texels);
  EXPECT_EQ(one.rays, two.rays);
}

TEST(HeldOut, CostTheShareThatWasAskedFor) {
  const Baked without = room(0.01), with = room(0.01, 0.1);
  EXPECT_EQ(without.radiosity.report.certificate.texels, 0u);
  EXPECT_GT(with.radiosity.report.certificate.texels, 0u);
  EXPECT_EQ(with.radiosity.report.refinements, 0);
  EXPECT_EQ(with.radiosity.pages[0].irradiance, without.radiosity.pages[0].irradiance) << "measuring changes nothing";
}

// A plate a hundredth of a texel above the floor: nobody looks into the gap, and both estimators leave it to their
// neighbours' light instead of telling darkness from darkness.
TEST(CoveredTexels, AreBuriedForBothEstimators) {
  SceneParts parts;
  const auto white = parts.diffuse(Vec3(0.6f));
  parts.quad("floor", white, {-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
  parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(10)), {-0.5f, 2, -0.5f}, {1, 0, 0}, {0, 0, 1});
  parts.box("plate", white, {-0.5f, 0.002f, -0.5f}, {0.5f, 0.05f, 0.5f});
  const Scene scene = parts.finish();
  std::vector<std::vector<TexelState>> states;
  for (const Estimator estimator : {Estimator::kReference, Estimator::kCached}) {
    const Baked b = test::bake(scene, 0.2f, {.estimator = estimator, .samples = 64});
    std::size_t buried = 0;
    for (std::size_t i = 0; i < b.texel_map[0].texel.size(); ++i) {
      const TexelPoint middle = sample_texel(b.atlas, b.texel_map[0], i, Vec3(0.5f));
      const SurfacePoint p = point_on_side(b.scene, middle.triangle, middle.barycentric);
      if (std::abs(p.position.y) > 1e-4f || std::max(std::abs(p.position.x), std::abs(p.position.z)) > 0.38f) continue;
      buried += b.radiosity.pages[0].state[b.texel_map[0].texel[i]] == TexelState::kBuried;
    }
    EXPECT_GE(buried, 4u);
    states.push_back(b.radiosity.pages[0].state);
  }
  EXPECT_EQ(states[0], states[1]);
}

// A texel lit by what one path in ten finds: where it is right, nothing is off on average, however often all paths miss
// the light. (Divided by the brighter of the texel and those paths, 0.75 were off.)
TEST(SquaredError, KnowsNothingOfThePathsNoise) {
  constexpr std::uint32_t kTexels = 2'000'000;
  for (const double light : {1.0, 0.5}) {
    double sum = 0, squares = 0;
    for (std::uint32_t i = 0; i < kTexels; ++i) {
      Sampler sampler(5, i, 0);
      std::array<DVec3, kEstimates> estimates;
      for (DVec3& e : estimates) e = DVec3(sampler.next1() < 0.1f ? 10.0 : 0.0);
      const double square = squared_error(DVec3(light), estimates, DVec3(0));
      sum += square, squares += square * square;
    }
    // The divisor is the texel's light where the third estimate has none.
    const double off = (light - 1) * (light - 1);
    const double noise = std::sqrt(squares) / kTexels;
    EXPECT_LT(noise, 0.03);
    EXPECT_NEAR(sum / kTexels, 0.9 * off / (light * light) + 0.1 * off / 100, 4 * noise) << light;
  }
}

}  // namespace
}  // namespace oriel
