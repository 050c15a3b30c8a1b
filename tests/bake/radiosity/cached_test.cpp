// The cached estimator against closed forms, and against unbiased paths where there is no closed form.
#include <gtest/gtest.h>

#include "tests/bake/radiosity/baked.h"
#include "tests/bake/radiosity/rooms.h"

namespace oriel {
namespace {

using test::bake;
using test::Baked;
using test::Feature;
using test::room;
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
class CachedFurnace : public ::testing::TestWithParam<std::tuple<bool, float>> {};

TEST_P(CachedFurnace, EveryTexelIsTheSeries) {
  const auto [sphere, albedo] = GetParam();
  SceneParts parts;
  const auto wall = parts.diffuse(Vec3(albedo), Vec3(1));
  if (sphere)
    parts.sphere("sphere", wall, Vec3(0), 1, 2, true);
  else
    parts.box("box", wall, Vec3(-1), Vec3(1), true);
  const Baked b = bake(parts.finish(), 0.15f, cached(1024));
  double worst = 0, sum = 0, squares = 0, stated = 0;
  int count = 0;
  b.each_texel([&](const LightmapPage& page, std::uint32_t t, std::uint32_t) {
    const double e = page.irradiance[t].g * (1 - albedo) / kPiD;
    const double error = page.standard_error[t].g * (1 - albedo) / kPiD;
    worst = std::max(worst, std::abs(e - 1) - 5 * error);
    sum += e, squares += (e - 1) * (e - 1), stated += error * error, ++count;
  });
  EXPECT_NEAR(sum / count, 1, 1e-3);
  EXPECT_LT(std::sqrt(squares / count), 1e-3 + 1.5 * std::sqrt(stated / count));
  // Beyond five standard errors, which neighbours share. In the corners, where paths tell what is near, a single texel
  // may keep its own noise: that of 1024 rays half of which find light of any strength.
  EXPECT_LT(worst, 0.5 / std::sqrt(1024.0));
  EXPECT_EQ(b.radiosity.report.buried, 0u);
}
INSTANTIATE_TEST_SUITE_P(Shapes, CachedFurnace,
                         ::testing::Combine(::testing::Bool(), ::testing::Values(0.0f, 0.5f, 0.9f, 0.99f)));

// So many reflections and no more: E = πL Σ ρ^k. The ball has too many lamps for closed forms, so that rays find a part
// of what shines on the surfaces that they meet; it was missing there, a sixth of all light with one bounce. Paths that
// go on from near surfaces in corners meet texels that hold as many bounces as others: there it may be one too many.
TEST(Cached, CountsBounces) {
  constexpr float kAlbedo = 0.5f;
  for (const bool ball : {true, false})
    for (const int bounces : {1, 2, 3}) {
      SceneParts parts;
      const auto wall = parts.diffuse(Vec3(kAlbedo), Vec3(1));
      if (ball)
        parts.sphere("ball", wall, Vec3(0), 1, 2, true);
      else
        parts.box("box", wall, Vec3(-1), Vec3(1), true);
      RadiosityOptions options = cached(256);
      options.bounces = bounces;
      const Baked b = bake(parts.finish(), 0.25f, options);
      double sum = 0, count = 0;
      b.each_texel([&](const LightmapPage& page, std::uint32_t t, std::uint32_t) {
        sum += page.irradiance[t].g / kPiD, ++count;
      });
      const double expected = (1 - std::pow(kAlbedo, bounces + 1)) / (1 - kAlbedo);
      const double one_more = std::pow(kAlbedo, bounces + 1);
      EXPECT_GT(sum / count, expected - 0.01) << bounces;
      EXPECT_LT(sum / count, expected + 0.01 + (bounces > 1 ? 0.25 * one_more : 0)) << bounces;
    }
}

// The same box beside a wall in light a hundred thousand times as strong, which is done after one bounce: the box is
// not.
TEST(Cached, ARoomIsNotCutShortByTheSunOutside) {
  SceneParts parts;
  parts.box("box", parts.diffuse(Vec3(0.9f), Vec3(1)), Vec3(-1), Vec3(1), true);
  parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(1e5f)), {5, 0, -5}, {0, 10, 0}, {0, 0, 10});
  parts.quad("wall", parts.diffuse(Vec3(0.5f)), {9, 0, -5}, {0, 0, 10}, {0, 10, 0});
  const Baked b = bake(parts.finish(), 0.25f, cached(256));
  double sum = 0, count = 0;
  b.each_texel([&](const LightmapPage& page, std::uint32_t t, std::uint32_t triangle) {
    if (b.scene.triangle_surface[triangle] == 0) sum += page.irradiance[t].g * (1 - 0.9) / kPiD, ++count;
  });
  ASSERT_GT(count, 0);
  EXPECT_NEAR(sum / count, 1, 5e-3);
}

// A room under a hole that shows 3 % of the sky, whose light few samples of the sky find: all that comes in is absorbed
// inside, but for what leaves by the hole. Texels that were asked again because a sample had met the hole came down to
// the truth while the others stayed dark: 26 and 12 % were missing.
TEST(Cached, ASkylightGivesAllItsLight) {
  constexpr float kSize = 4, kHole = 0.5f, kSide = (kSize - kHole) / 2;
  constexpr double kAlbedo = 0.5, kArea = 6.0 * kSize * kSize - kHole * kHole;
  SceneParts parts;
  const auto white = parts.diffuse(Vec3(float{kAlbedo}));
  const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  parts.quad("floor", white, {0, 0, kSize}, kSize * x, -kSize * z);
  parts.quad("north", white, {0, 0, 0}, kSize * x, kSize * y);
  parts.quad("south", white, {kSize, 0, kSize}, -kSize * x, kSize * y);
  parts.quad("west", white, {0, 0, kSize}, -kSize * z, kSize * y);
  parts.quad("east", white, {kSize, 0, 0}, kSize * z, kSize * y);
  parts.quad("ceiling north", white, {0, kSize, 0}, kSize * x, kSide * z);
  parts.quad("ceiling south", white, {0, kSize, kSize - kSide}, kSize * x, kSide * z);
  parts.quad("ceiling west", white, {0, kSize, kSide}, kSide * x, kHole * z);
  parts.quad("ceiling east", white, {kSize - kSide, kSize, kSide}, kSide * x, kHole * z);
  SkyImage& sky = parts.scene().sky_image = {2, 64, std::vector<Vec3>(128, Vec3(1))};
  std::fill(sky.texels.begin() + 64, sky.texels.end(), Vec3(0.5f));  // below the horizon: one colour is not sampled
  for (const RadiosityOptions& options : {cached(256), to_error(0.02)}) {
    const Baked b = bake(parts.finish(), 0.25f, options);
    std::vector<double> light(b.scene.surfaces.size()), count(light.size()), area(light.size());
    for (std::uint32_t t = 0; t < b.scene.triangles.size(); ++t)
      area[b.scene.triangle_surface[t]] += triangle_area(b.scene, t);
    b.each_texel([&](const LightmapPage& page, std::uint32_t t, std::uint32_t triangle) {
      light[b.scene.triangle_surface[triangle]] += page.irradiance[t].g, ++count[b.scene.triangle_surface[triangle]];
    });
    double kept = 0;
    for (std::size_t s = 0; s < light.size(); ++s) kept += (1 - kAlbedo) * area[s] * light[s] / count[s];
    const double in = kPiD * kHole * kHole, out = kAlbedo / (1 - kAlbedo) * in * kHole * kHole / kArea;
    EXPECT_NEAR(kept / (in - out), 1, 0.015) << "asked for " << options.error;
  }
}

// Mean of the light by surface, against unbiased paths: within 0.3 %, four standard errors of independent texels and
// one of texels among which the filter spread their noise.
class CachedAgrees : public ::testing::TestWithParam<Feature> {};

TEST_P(CachedAgrees, SurfaceMeansEqualUnbiasedPaths) {
  const Scene scene = room(GetParam());
  RadiosityOptions paths;
  paths.samples = 512;
  paths.dilation = 0;
  const Baked truth = bake(scene, 0.12f, paths), b = bake(scene, 0.12f, to_error(0.01));
  struct Sum {
    double difference = 0, mean = 0, noise = 0, shared = 0;
  };
  const Scene& split = truth.scene;  // more triangles than the room has, where both sides of some are lit
  std::vector<Sum> sums(split.surfaces.size());
  truth.each_texel([&](const LightmapPage& page, std::uint32_t t, std::uint32_t triangle) {
    const std::size_t p = static_cast<std::size_t>(&page - truth.radiosity.pages.data());
    const LightmapPage& other = b.radiosity.pages[p];
    if (other.state[t] != TexelState::kValid) return;
    Sum& sum = sums[split.triangle_surface[triangle]];
    sum.mean += page.irradiance[t].g;
    sum.difference += other.irradiance[t].g - page.irradiance[t].g;
    sum.noise += std::pow(page.standard_error[t].g, 2) + std::pow(other.standard_error[t].g, 2);
    sum.shared += other.standard_error[t].g;
  });
  for (std::size_t s = 0; s < sums.size(); ++s) {
    if (sums[s].mean <= 0) continue;
    EXPECT_NEAR(sums[s].difference, 0, 0.003 * sums[s].mean + 4 * std::sqrt(sums[s].noise) + sums[s].shared)
        << split.surfaces[s].name << ", of " << sums[s].mean;
  }
}
INSTANTIATE_TEST_SUITE_P(Features, CachedAgrees,
                         ::testing::Values(Feature::kMatt, Feature::kGlossyFloor, Feature::kMirror, Feature::kGlass,
                                           Feature::kCutOut, Feature::kSphere, Feature::kPoint, Feature::kSky,
                                           Feature::kDielectric, Feature::kManyLamps));

// Under a slab 3 cm over the floor texels of 20 cm see little but each other from close by, and none of them stands for
// what is met: dark below, with a bright rim.
TEST(Cached, TellsTheLightOfAGapNarrowerThanATexel) {
  SceneParts parts;
  const auto white = parts.diffuse(Vec3(0.8f));
  parts.quad("floor", white, {-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
  parts.box("slab", white, {-0.33f, 0.03f, -0.37f}, {0.35f, 0.1f, 0.31f});
  parts.scene().sky = Vec3(1);
  const Scene scene = parts.finish();
  RadiosityOptions paths;
  paths.samples = 8192;
  paths.dilation = 0;
  const Baked truth = bake(scene, 0.2f, paths), b = bake(scene, 0.2f, to_error(0.02));
  double squares = 0;
  int dark = 0;
  truth.each_texel([&](const LightmapPage& page, std::uint32_t t, std::uint32_t) {
    const LightmapPage& other = b.radiosity.pages[static_cast<std::size_t>(&page - truth.radiosity.pages.data())];
    const double light = page.irradiance[t].g;
    if (light > 0.4 * kPiD) return;
    squares += std::pow(other.irradiance[t].g / light - 1, 2);
    ++dark;
  });
  ASSERT_GT(dark, 10);
  EXPECT_LT(std::sqrt(squares / dark), 0.1) << "looked up in texels it is 0.96";
}

// Exporters write panels that shine to both sides. What one sends into the gap of 2 cm above it comes out again by the
// rim, though nobody looks in there.
TEST(Cached, HasTheLightThatALampSendsIntoTheGapAboveIt) {
  SceneParts parts;
  parts.box("room", parts.diffuse(Vec3(0.7f)), Vec3(0), {2, 2, 2}, true);
  const auto panel = parts.diffuse(Vec3(0.7f), Vec3(10));
  parts.scene().materials[panel].double_sided = true;
  parts.quad("panel", panel, {0.73f, 1.98f, 0.75f}, {0.5f, 0, 0}, {0, 0, 0.5f});
  const Scene scene = parts.finish();
  RadiosityOptions o = to_error(0.02);
  for (int i = 0; i < 9; ++i)
    o.eyes.emplace_back(0.5f + 0.5f * static_cast<float>(i % 3), 1.5f, 0.5f + 0.5f * static_cast<float>(i / 3));
  const auto floor_lux = [](const Baked& b) {
    double light = 0, area = 0;
    b.each_texel([&](const LightmapPage& page, std::uint32_t t, std::uint32_t triangle) {
      if (b.scene.positions[b.scene.triangles[triangle].x].y > 0 || geometric_normal(b.scene, triangle).y < 0.5f)
        return;
      light += page.irradiance[t].g, ++area;
    });
    return light / area;
  };
  const double truth = floor_lux(bake(scene, 0.5f, {.samples = 4096}));
  EXPECT_NEAR(floor_lux(bake(scene, 0.08f, o)), truth, 0.015 * truth) << "without that light it is 2.9 % less";
}

// A closed shaft stands on a lit floor, all of it on one texel, most of which lies outside. The shaft is as black as a
// closed room, though rays in it meet that texel, and from far.
TEST(Cached, NoLightComesThroughTexelsThatReachUnderAWall) {
  SceneParts parts;
  const auto white = parts.diffuse(Vec3(0.8f));
  parts.quad("floor", white, {-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
  constexpr float kLow = 0.12f, kHigh = 0.38f, kThick = 0.02f, kTop = 1.5f;  // of the inside
  parts.box("west", white, {kLow - kThick, 0, kLow - kThick}, {kLow, kTop, kHigh + kThick});
  parts.box("east", white, {kHigh, 0, kLow - kThick}, {kHigh + kThick, kTop, kHigh + kThick});
  parts.box("north", white, {kLow, 0, kLow - kThick}, {kHigh, kTop, kLow});
  parts.box("south", white, {kLow, 0, kHigh}, {kHigh, kTop, kHigh + kThick});
  parts.box("lid", white, {kLow - kThick, kTop, kLow - kThick}, {kHigh + kThick, kTop + kThick, kHigh + kThick});
  parts.scene().sky = Vec3(1);
  const Baked b = bake(parts.finish(), 0.5f, to_error(0.05));
  const auto is_inside = [](float x) { return x > kLow && x < kHigh; };
  double light = 0;
  int count = 0;
  b.each_texel([&](const LightmapPage& page, std::uint32_t t, std::uint32_t triangle) {
    const SurfacePoint p = point_on_side(b.scene, triangle, Vec2(1.0f / 3));
    const Vec3 ahead = p.position + 0.01f * p.geometric_normal;
    if (!is_inside(ahead.x) || !is_inside(ahead.z) || ahead.y > kTop || ahead.y < 0.1f) return;
    light += page.irradiance[t].g;
    ++count;
  });
  ASSERT_GE(count, 8);
  EXPECT_LT(light / count, 0.01 * kPiD) << "looked up in the floor's texel it is 0.15";
}

void expect_same_light(const Baked& a, const Baked& b) {
  EXPECT_EQ(a.radiosity.pages[0].irradiance, b.radiosity.pages[0].irradiance);
  EXPECT_EQ(a.radiosity.pages[0].standard_error, b.radiosity.pages[0].standard_error);
}

TEST(Cached, OneAndTwoThreadsGiveTheSameBytes) {
  const Scene scene = room(Feature::kDielectric);
  expect_same_light(bake(scene, 0.15f, to_error(0.05), 1), bake(scene, 0.15f, to_error(0.05), 2));
}

// Rays end the work where an error takes more of them, at the same place for any number of threads.
TEST(Cached, EndsWhenRaysAreSpentAndStatesTheErrorThatIsThere) {
  const Scene scene = room(Feature::kDielectric);
  RadiosityOptions options = to_error(0.002);
  options.most_rays = 1;  // and what texels may have on average
  const Baked a = bake(scene, 0.15f, options, 1), b = bake(scene, 0.15f, options, 2);
  expect_same_light(a, b);
  const RadiosityReport& ended = a.radiosity.report;
  EXPECT_TRUE(ended.out_of_rays);
  EXPECT_FALSE(ended.ended_early) << "that is time's";
  EXPECT_GT(ended.relative_error, 0.002);
  options.most_rays = 0;
  const RadiosityReport whole = bake(scene, 0.15f, options).radiosity.report;
  EXPECT_FALSE(whole.out_of_rays);
  EXPECT_LT(whole.relative_error, 0.8 * ended.relative_error);
  EXPECT_GT(whole.rays, 2 * ended.rays);
  options.most_rays = 1, options.error = 0.1;
  EXPECT_FALSE(bake(scene, 0.15f, options).radiosity.report.out_of_rays) << "the error is there first";
}

}  // namespace
}  // namespace oriel
