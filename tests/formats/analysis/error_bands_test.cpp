// Where errors lie, by size: against patterns whose bands are known.
#include "formats/analysis/error_bands.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "formats/image/contrast_sensitivity.h"

namespace oriel {
namespace {

constexpr std::uint32_t kSize = 64;
constexpr float kLux = 100;

// A wall of 6.4 m of texels of 10 cm, seen from 3 m; off(x, y): its light beside kLux.
Pack wall(const std::function<float(std::uint32_t, std::uint32_t)>& off, float error_lux = 0) {
  Pack pack;
  pack.materials.resize(1);
  for (const Vec2& uv : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)}) {
    pack.mesh.positions.emplace_back(6.4f * uv.x, 6.4f * uv.y, 0);
    pack.mesh.lightmap_uvs.push_back(uv);
  }
  pack.mesh.indices = {0, 1, 2, 0, 2, 3};
  pack.mesh.parts.push_back({"wall", 0, 6, 0, 0});
  LightmapPage page;
  page.width = page.height = kSize;
  for (std::uint32_t i = 0; i < kSize * kSize; ++i) page.irradiance.emplace_back(kLux + off(i % kSize, i / kSize));
  page.standard_error.assign(page.irradiance.size(), Vec3(error_lux));
  page.state.assign(page.irradiance.size(), TexelState::kValid);
  pack.lightmaps.push_back(std::move(page));
  return pack;
}

float even(std::uint32_t, std::uint32_t) {
  return 0;
}

std::function<float(std::uint32_t, std::uint32_t)> noise(float lux, unsigned seed) {
  const auto random = std::make_shared<std::mt19937>(seed);
  return [=](std::uint32_t, std::uint32_t) { return std::normal_distribution<float>(0, lux)(*random); };
}

double total(const BandErrors& e) {
  double square = e.wider * e.wider;
  for (const double band : e.band) square += band * band;
  return std::sqrt(square);
}

// Scale of the reference's light and the floor for the dark.
const double kScale = 1 / std::sqrt(1.01);

TEST(ErrorBands, WhiteNoiseHalvesFromBandToBand) {
  const auto bands = error_bands(wall(even), wall(noise(2, 1)));
  ASSERT_TRUE(bands);
  EXPECT_EQ(bands->all.texels, kSize * kSize);
  EXPECT_NEAR(total(bands->all), 0.02 * kScale, 0.0005);
  double expected = 0.02 * kScale * std::sqrt(0.75);
  for (std::size_t k = 0; k < 3; ++k, expected /= 2)
    EXPECT_NEAR(bands->all.band[k], expected, 0.12 * expected) << "band " << k;
}

TEST(ErrorBands, APatternIsInTheBandOfItsSize) {
  for (std::size_t k = 0; k < kErrorBands; ++k) {
    const auto checks = [&](std::uint32_t x, std::uint32_t y) { return ((x >> k) + (y >> k)) % 2 == 0 ? 1.0f : -1.0f; };
    const auto bands = error_bands(wall(even), wall(checks));
    ASSERT_TRUE(bands);
    for (std::size_t other = 0; other < kErrorBands; ++other)
      EXPECT_NEAR(bands->all.band[other], other == k ? 0.01 * kScale : 0, 1e-6) << k << " in " << other;
    EXPECT_NEAR(bands->all.wider, 0, 1e-6);
  }
  const auto brighter = error_bands(wall(even), wall([](std::uint32_t, std::uint32_t) { return 3.0f; }));
  EXPECT_NEAR(brighter->all.wider, 0.03 * kScale, 1e-6);
  EXPECT_NEAR(total(brighter->all), brighter->all.wider, 1e-6);
}

TEST(ErrorBands, TheReferencesNoiseIsTakenOff) {
  const auto bands = error_bands(wall(noise(5, 1), 5), wall(noise(1, 2)));
  ASSERT_TRUE(bands);
  EXPECT_NEAR(total(bands->all), 0.01, 0.006) << "with it: 0.051";
  const auto alone = error_bands(wall(noise(5, 1), 0), wall(noise(1, 2)));
  EXPECT_NEAR(total(alone->all), 0.051 * kScale, 0.002);
}

TEST(ErrorBands, ChartsThatLieSideBySideAreApart) {
  // Two halves of a page that are two walls: one brighter, one darker, which is no pattern of theirs.
  const auto halves = [](std::uint32_t x, std::uint32_t) { return x < 16 ? 1.0f : -1.0f; };
  Pack first = wall(even), second = wall(halves);
  for (Pack* pack : {&first, &second})
    for (std::uint32_t y = 0; y < kSize; ++y) pack->lightmaps[0].state[y * kSize + 16] = TexelState::kDilated;
  const auto bands = error_bands(first, second);
  ASSERT_TRUE(bands);
  EXPECT_NEAR(bands->all.band[4], 0, 1e-6);
  EXPECT_NEAR(bands->all.band[5], 0, 1e-6);
  EXPECT_NEAR(total(bands->all), 0.01 * kScale, 1e-5);
}

TEST(ErrorBands, WhatIsVisibleGoesByTheNearestEye) {
  const auto checks = [](std::uint32_t x, std::uint32_t y) { return (x / 4 + y / 4) % 2 == 0 ? 1.0f : -1.0f; };
  for (const float distance : {1.0f, 50.0f}) {
    Pack first = wall(even), second = wall(checks);
    first.cameras.push_back({"far", Vec3(3.2f, 3.2f, 100)});
    first.cameras.push_back({"near", Vec3(3.2f, 3.2f, distance)});
    first.cameras.push_back({"behind", Vec3(3.2f, 3.2f, -0.5f)});
    const auto bands = error_bands(first, second);
    ASSERT_TRUE(bands);
    // From 50 m the wall is as good as flat on to the eye; from 1 m most of it is seen from further away.
    const double degrees = std::atan(0.1 / distance) * 180 / kPiD;
    const double visible = std::sqrt(2) * 0.01 * kScale * contrast_sensitivity(1 / (2 * 4 * degrees));
    if (distance > 10)
      EXPECT_NEAR(bands->all.visible, visible, 0.02 * visible);
    else
      EXPECT_GT(bands->all.visible, visible);
  }
}

TEST(ErrorBands, NothingIsSaidOfOtherAtlases) {
  Pack other = wall(even);
  other.mesh.lightmap_uvs[1].x = 0.5f;
  EXPECT_FALSE(error_bands(wall(even), other));
  Pack empty = wall(even);
  empty.lightmaps[0].state.assign(kSize * kSize, TexelState::kEmpty);
  EXPECT_FALSE(error_bands(empty, wall(even)));
}

// Barten 2004, figure 1: some seven hundred between two and three cycles a degree, a hundredth of it at 40.
TEST(ContrastSensitivity, HasItsPeakAtTwoToThreeCyclesADegree) {
  double best = 0, at = 0;
  for (double u = 0.1; u < 60; u *= 1.02)
    if (contrast_sensitivity(u) > best) best = contrast_sensitivity(u), at = u;
  EXPECT_GT(at, 1.5);
  EXPECT_LT(at, 4);
  EXPECT_NEAR(best, 720, 40);
  EXPECT_LT(contrast_sensitivity(40), 0.03 * best);
  EXPECT_LT(contrast_sensitivity(0.05), 0.1 * best);
}

}  // namespace
}  // namespace oriel
