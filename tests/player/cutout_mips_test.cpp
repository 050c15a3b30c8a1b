#include "player/images/cutout_mips.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace oriel {
namespace {

using Rgba = std::array<std::uint8_t, 4>;

// texel(x, y)
template <class F>
Texture make_texture(std::uint32_t width, std::uint32_t height, F texel) {
  Texture out;
  out.width = width;
  out.height = height;
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x)
      for (const std::uint8_t channel : Rgba(texel(x, y))) out.texels.push_back(channel);
  return out;
}

constexpr Rgba kLeaf{40, 90, 20, 255}, kAway{255, 255, 255, 0};

double passing(const std::vector<std::uint8_t>& level, float cutoff) {
  std::size_t count = 0;
  for (std::size_t i = 3; i < level.size(); i += 4) count += static_cast<float>(level[i]) / 255 >= cutoff ? 1 : 0;
  return static_cast<double>(count) / (static_cast<double>(level.size()) / 4);
}

TEST(CutoutMips, WhatIsCutAwayHasNoShareInAnyLevelsColour) {
  for (const float cutoff : {0.5f, 0.0f}) {  // 0: blended
    const Texture t = make_texture(
        64, 32, [](std::uint32_t x, std::uint32_t y) { return x % 7 == 0 && y % 3 != 0 && x < 40 ? kLeaf : kAway; });
    const auto levels = cutout_mips(t, cutoff);
    ASSERT_EQ(levels.size(), 7u);
    EXPECT_EQ(levels[0], t.texels);
    for (std::size_t level = 1; level < levels.size(); ++level) {
      for (std::size_t i = 0; i < levels[level].size(); i += 4)
        for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(levels[level][i + c], kLeaf[c]) << level;
    }
  }
}

TEST(CutoutMips, AsMuchPassesTheCutoffInEachLevel) {
  const Texture t = make_texture(
      128, 128, [](std::uint32_t x, std::uint32_t y) { return std::hypot(x - 50.3, y - 70.9) < 40 ? kLeaf : kAway; });
  for (const float cutoff : {0.1f, 0.5f, 0.9f}) {
    const auto levels = cutout_mips(t, cutoff);
    const double wanted = passing(levels[0], cutoff);
    for (std::size_t level = 1; level < 4; ++level)  // to 16 x 16: 1.5 % are four texels, which may have one alpha
      EXPECT_NEAR(passing(levels[level], cutoff), wanted, 0.015) << cutoff << " " << level;
  }
}

TEST(CutoutMips, MeansAreOfLinearLightWeightedByAlphaWhereBlended) {
  const Texture t = make_texture(2, 1, [](std::uint32_t x, std::uint32_t) {
    return x == 0 ? Rgba{255, 255, 255, 51} : Rgba{0, 0, 0, 204};
  });
  const auto levels = cutout_mips(t, 0);
  ASSERT_EQ(levels.size(), 2u);
  // A fifth of white is 0.4845 encoded; alpha is the plain mean.
  EXPECT_EQ(levels[1], (std::vector<std::uint8_t>{124, 124, 124, 128}));
}

TEST(CutoutMips, OddSizesGiveEachTexelItsShare) {
  const Texture t = make_texture(3, 1, [](std::uint32_t x, std::uint32_t) {
    return Rgba{static_cast<std::uint8_t>(x == 1 ? 255 : 0), 0, 0, 255};
  });
  const auto levels = cutout_mips(t, 0.5f);
  ASSERT_EQ(levels.size(), 2u);
  EXPECT_EQ(levels[1], (std::vector<std::uint8_t>{156, 0, 0, 255}));  // a third of the light
}

TEST(CutoutMips, NothingPassesOrASingleTexel) {
  const auto none = cutout_mips(make_texture(4, 4, [](std::uint32_t, std::uint32_t) { return kAway; }), 0.5f);
  ASSERT_EQ(none.size(), 3u);
  for (const auto& level : none) EXPECT_EQ(passing(level, 0.5f), 0);
  EXPECT_EQ(cutout_mips(make_texture(1, 1, [](std::uint32_t, std::uint32_t) { return kLeaf; }), 0.5f).size(), 1u);
}

}  // namespace
}  // namespace oriel
