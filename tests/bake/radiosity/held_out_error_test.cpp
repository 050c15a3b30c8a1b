// What held-out pixels tell: the error that is there, whatever the bake says of itself.
#include "bake/radiosity/held_out_error.h"

#include <gtest/gtest.h>

#include "bake/trace/sampler.h"

#include "tests/bake/radiosity/baked.h"
#include "tests/bake/radiosity/rooms.h"

namespace oriel {
namespace {

using test::Baked;
using test::SceneParts;

constexpr std::uint64_t kManyRays = 4'000'000;

Baked certified_room(double error, double verify = 0) {
  return test::bake(
      test::room(test::Feature::kMatt), 0.15f,
      {.estimator = Estimator::kCached, .samples = 4096, .error = error, .verify = verify, .fit_texels = true});
}

// Pixels that no bake knows.
constexpr std::uint64_t kHeldOutSeed = 0x5ee;

std::vector<FramePixel> pixels_of(const Baked& b, const Transport& transport, std::uint64_t seed = kHeldOutSeed) {
  Context context;
  return *find_frame_pixels(transport, b.atlas, {sample_view_positions(transport, 1024, seed), 16}, seed, context);
}

HeldOutError held_out_error_of(const Baked& b, double asked, std::uint64_t rays, int threads = 0,
                               std::uint64_t seed = kHeldOutSeed) {
  Context context;
  context.threads = threads;
  context.seed = seed;
  const Accel accel = *Accel::build(b.scene);
  const LightSet lights(b.scene);
  const Transport transport{accel, lights, {}};
  return *measure_held_out_error({transport, b.atlas, b.texel_map}, b.radiosity.pages, pixels_of(b, transport, seed),
                                 {asked, rays}, context);
}

// Multiplies every second texel by 1 + off, the others by 1 - off.
void spoil(Baked& b, float off) {
  for (LightmapPage& page : b.radiosity.pages)
    for (std::size_t i = 0; i < page.irradiance.size(); ++i)
      page.irradiance[i] *= 1 + ((i + i / page.width) % 2 == 0 ? off : -off);
}

// The error that spoiling the light of `good` to that of `bad` adds where pixels read it.
double added_error(const Baked& good, const Baked& bad, std::uint64_t seed) {
  const Accel accel = *Accel::build(good.scene);
  const LightSet lights(good.scene);
  const std::vector<FramePixel> pixels = pixels_of(good, {accel, lights, {}}, seed);
  const auto shown = [](const Baked& b, const FramePixel& pixel) {
    DVec3 light(0);
    for (std::size_t k = 0; k < pixel.texel.size(); ++k)
      light += double{pixel.share[k]} * DVec3(b.radiosity.pages[pixel.page].irradiance[pixel.texel[k]]);
    return light * DVec3(pixel.transfer);
  };
  const auto floors2 = frame_floors2(pixels, [&](std::size_t i) { return shown(good, pixels[i]); });
  double sum = 0;
  for (const FramePixel& pixel : pixels) {
    const DVec3 is = shown(good, pixel) + DVec3(pixel.emitted), off = shown(bad, pixel) - shown(good, pixel);
    const DVec3 brighter = glm::max(is, is + off);  // as squared_error() divides
    sum += relative_square(off * off, brighter * brighter, floors2[pixel.view]);
  }
  return std::sqrt(sum / static_cast<double>(pixels.size()));
}

TEST(HeldOut, TellTheErrorThatIsThere) {
  const Baked clean = certified_room(0.02);
  const HeldOutError good = held_out_error_of(clean, 0.02, kManyRays);
  EXPECT_GT(good.pixels, 64u);
  Baked b = clean;
  spoil(b, 0.4f);
  int held = 0;
  constexpr int kTimes = 5;  // an interval of 95 % may miss once
  for (std::uint64_t seed = kHeldOutSeed; seed < kHeldOutSeed + kTimes; ++seed) {
    const HeldOutError spoilt = held_out_error_of(b, 0.05, kManyRays, 0, seed);
    const double added = added_error(clean, b, seed);
    EXPECT_GT(added, 0.1) << "a third of it is left between texels";
    const double expected = std::hypot(added, good.relative_error);
    held += spoilt.error_low <= expected && expected <= spoilt.error_high;
    EXPECT_GT(spoilt.error_low, 0.05) << "and says that it is not what the bake states, "
                                      << b.radiosity.report.relative_error;
  }
  EXPECT_GE(held, kTimes - 1) << "the interval holds it";
}

// One surface is wrong: the worst pixels are its.
TEST(HeldOut, NameTheWorst) {
  Baked b = certified_room(0.02);
  const std::uint32_t wrong = b.scene.surfaces[0].first_triangle, end = wrong + b.scene.surfaces[0].triangle_count;
  for (std::size_t p = 0; p < b.texel_map.size(); ++p)
    for (std::size_t i = 0; i < b.texel_map[p].texel.size(); ++i) {
      const std::uint32_t t = b.texel_map[p].fragments[b.texel_map[p].first[i]].triangle;
      if (t >= wrong && t < end) b.radiosity.pages[p].irradiance[b.texel_map[p].texel[i]] *= 2.0f;
    }
  const HeldOutError c = held_out_error_of(b, 0.05, kManyRays);
  ASSERT_GE(c.worst.size(), 3u) << "else there is nothing to look at";
  double share = 0, last = 1;
  for (const WorstPixel& w : c.worst) {
    EXPECT_TRUE(w.triangle >= wrong && w.triangle < end) << w.triangle;
    EXPECT_NEAR(w.baked / w.paths, 2, 0.4) << "twice, and what texels of 15 cm miss at shadows: 15 % without a filter";
    EXPECT_LE(w.share, last);
    share += last = w.share;
  }
  EXPECT_LE(share, 1);
}

// Texels of half a metre in a room of two are right and yet no light to look at.
TEST(HeldOut, TellOfTexelsThatAreTooLarge) {
  const auto held_out_error = [](float texel_m) {
    return held_out_error_of(test::bake(test::room(test::Feature::kMatt), texel_m,
                                        {.estimator = Estimator::kCached, .samples = 4096, .error = 0.02, .verify = 0}),
                             0.02, kManyRays);
  };
  const HeldOutError coarse = held_out_error(0.5f), fine = held_out_error(0.05f);
  EXPECT_GT(coarse.error_low, 0.06);
  EXPECT_LT(fine.error_low, 0.03);
  EXPECT_LT(fine.relative_error, 0.5 * coarse.relative_error);
}

TEST(HeldOut, FewRaysGiveAWiderInterval) {
  Baked b = certified_room(0.05);
  spoil(b, 0.1f);
  const HeldOutError few = held_out_error_of(b, 0.02, 1), many = held_out_error_of(b, 0.02, kManyRays);
  EXPECT_GT(few.pixels, 0u) << "a first batch there is";
  EXPECT_LT(few.rays, many.rays / 10);
  EXPECT_GT(few.error_high - few.error_low, many.error_high - many.error_low);
}

TEST(HeldOut, AreTheSameForAnyThreads) {
  const Baked b = certified_room(0.05);
  const HeldOutError one = held_out_error_of(b, 0.05, 500'000, 1), two = held_out_error_of(b, 0.05, 500'000, 2);
  EXPECT_EQ(one.relative_error, two.relative_error);
  EXPECT_EQ(one.pixels, two.pixels);
  EXPECT_EQ(one.rays, two.rays);
}

TEST(HeldOut, CostTheShareThatWasAskedFor) {
  const Baked without = certified_room(0.01), with = certified_room(0.01, 0.1);
  EXPECT_EQ(without.radiosity.report.held_out_error.pixels, 0u);
  EXPECT_GT(with.radiosity.report.held_out_error.pixels, 0u);
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

// A pixel lit by what one path in ten finds: where it is right, nothing is off on average, however often all paths miss
// the light. (Divided by the brighter of the pixel and those paths, 0.75 were off.)
TEST(SquaredError, KnowsNothingOfThePathsNoise) {
  constexpr std::uint32_t kPixels = 2'000'000;
  for (const double light : {1.0, 0.5}) {
    double sum = 0, squares = 0;
    for (std::uint32_t i = 0; i < kPixels; ++i) {
      Sampler sampler(5, i, 0);
      std::array<DVec3, kEstimates> estimates;
      for (DVec3& e : estimates) e = DVec3(sampler.next1() < 0.1f ? 10.0 : 0.0);
      const double square = squared_error(DVec3(light), estimates, DVec3(0));
      sum += square, squares += square * square;
    }
    // The divisor is the pixel's light where the third estimate has none.
    const double off = (light - 1) * (light - 1);
    const double noise = std::sqrt(squares) / kPixels;
    EXPECT_LT(noise, 0.03);
    EXPECT_NEAR(sum / kPixels, 0.9 * off / (light * light) + 0.1 * off / 100, 4 * noise) << light;
  }
}

}  // namespace
}  // namespace oriel
