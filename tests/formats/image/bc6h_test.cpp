// BC6H: what is packed comes back, and pictures come back within the format's reach. tests/player holds blocks of all
// kinds against the device's own decoder.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "formats/core/half.h"
#include "formats/image/block.h"
#include "formats/image/encode.h"

namespace oriel {
namespace {

TEST(Bc6h, LayoutsHoldEachBitOnce) {
  for (std::size_t m = 0; m < bc6h::modes().size(); ++m) {
    const bc6h::Mode& mode = bc6h::modes()[m];
    EXPECT_EQ(mode.code_bits + static_cast<int>(bc6h::bits_of(m).size()), mode.lines == 1 ? 65 : 77) << m;
    std::array<std::array<std::uint32_t, 3>, 4> seen{};
    for (const bc6h::Bit& bit : bc6h::bits_of(m)) {
      std::uint32_t& mask = seen[bit.endpoint][bit.channel];
      EXPECT_EQ(mask >> bit.bit & 1, 0u) << m;
      mask |= 1u << bit.bit;
    }
    for (std::size_t e = 0; e < 2 * static_cast<std::size_t>(mode.lines); ++e)
      for (int c = 0; c < 3; ++c)
        EXPECT_EQ(seen[e][static_cast<std::size_t>(c)], (1u << (e == 0 ? mode.bits : mode.more_bits[c])) - 1) << m;
  }
}

TEST(Bc6h, WhatIsPackedComesBack) {
  std::mt19937 random(3);
  for (std::size_t m = 0; m < bc6h::modes().size(); ++m)
    for (int round = 0; round < 50; ++round) {
      const bc6h::Mode& mode = bc6h::modes()[m];
      const std::uint32_t all = (1u << mode.bits) - 1;
      bc6h::Fields fields;
      fields.mode = m;
      fields.partition = mode.lines == 2 ? static_cast<std::uint32_t>(random() % 32) : 0;
      for (std::size_t e = 0; e < 2 * static_cast<std::size_t>(mode.lines); ++e)
        for (std::size_t c = 0; c < 3; ++c) {
          const std::uint32_t more = 1u << mode.more_bits[static_cast<int>(c)];
          std::uint32_t& value = fields.endpoints[e][c];
          value = static_cast<std::uint32_t>(random()) & all;
          if (e > 0 && mode.differences) value = (fields.endpoints[0][c] + value % more - more / 2) & all;
        }
      for (int i = 0; i < bc6h::kTexels; ++i) {
        const bool anchored = i == 0 || (mode.lines == 2 && i == bc6h::anchor(fields.partition));
        const std::uint32_t levels = (mode.lines == 1 ? 16u : 8u) >> (anchored ? 1 : 0);
        fields.index[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(random() % levels);
      }
      bc6h::Fields read;
      ASSERT_TRUE(bc6h::unpacked(bc6h::packed(fields), read));
      EXPECT_EQ(read.mode, fields.mode);
      EXPECT_EQ(read.partition, fields.partition);
      EXPECT_EQ(read.endpoints, fields.endpoints) << m;
      EXPECT_EQ(read.index, fields.index);
    }
}

TEST(Bc6h, ReservedCodesAreBlack) {
  for (const int code : {0b10011, 0b10111, 0b11011, 0b11111}) {
    bc6h::Block block;
    block.fill(std::byte{0xFF});
    block[0] = static_cast<std::byte>(0xE0 | code);
    for (const auto& texel : bc6h::decoded(block)) EXPECT_EQ(texel, (glm::vec<3, std::uint16_t>(0)));
  }
}

// Root mean square over channels, of each texel's largest.
double relative_error(const std::vector<Vec3>& was, const std::vector<Vec3>& is, double* worst = nullptr) {
  double squares = 0;
  for (std::size_t i = 0; i < was.size(); ++i) {
    const double off = glm::length(DVec3(is[i] - was[i])) / std::max(double{max_component(was[i])}, 1e-30);
    squares += off * off;
    if (worst != nullptr) *worst = std::max(*worst, off);
  }
  return std::sqrt(squares / (3 * static_cast<double>(was.size())));
}

std::vector<Vec3> through(const std::vector<Vec3>& rgb, std::uint32_t width, std::uint32_t height,
                          std::span<const std::uint8_t> counts = {}) {
  const Bytes blocks = bc6h_blocks(rgb, width, height, counts);
  EXPECT_EQ(blocks.size(), std::size_t{(width + 3) / 4} * ((height + 3) / 4) * 16);
  return rgb_from_bc6h(blocks, width, height);
}

// Sixteen bits an end are those of the half floats themselves.
TEST(Bc6h, OneColourIsExact) {
  for (const float scale : {0.0f, 6e-8f, 1e-4f, 0.37f, 1.0f, 300.0f, 20000.0f, 65504.0f}) {
    std::vector<Vec3> rgb(16, scale * Vec3(1, 0.3f, 0.02f));
    for (const Vec3& texel : through(rgb, 4, 4))
      for (int c = 0; c < 3; ++c) EXPECT_EQ(texel[c], float_from_half(half_from_float(rgb[0][c]))) << scale;
  }
}

// A wall under a lamp, of any brightness: no step between the 16 points of a line is more than 5/64 of it, so that no
// texel is off by more than half that share of what its block spans, and by the half float's own rounding.
TEST(Bc6h, SmoothLightIsOffByLessThanAStepOfItsBlock) {
  constexpr std::uint32_t kSide = 64;
  for (const float scale : {0.01f, 300.0f, 60000.0f}) {
    std::vector<Vec3> rgb;
    for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
      const float x = static_cast<float>(i % kSide) / kSide, y = static_cast<float>(i / kSide) / kSide;
      rgb.push_back(scale / std::pow(1 + x * x + y * y, 2.0f) * Vec3(1, 0.9f, 0.7f));
    }
    const std::vector<Vec3> read = through(rgb, kSide, kSide);
    double allowed = 0;
    for (std::uint32_t block = 0; block < kSide * kSide / 16; ++block) {
      float low = std::numeric_limits<float>::max(), high = 0;
      for (std::uint32_t i = 0; i < 16; ++i) {
        const float v = rgb[(block / 16 * 4 + i / 4) * kSide + block % 16 * 4 + i % 4].r;
        low = std::min(low, v), high = std::max(high, v);
      }
      allowed += std::pow(2.5 / 64 * (high - low) / low + 0x1p-10, 2) / (kSide * kSide / 16);
    }
    EXPECT_LT(relative_error(rgb, read), std::sqrt(allowed)) << scale;
  }
}

// Light and shade meet within blocks, on a line that a partition has: a second line of the block tells both.
TEST(Bc6h, AnEdgeOfShadeIsTold) {
  constexpr std::uint32_t kSide = 16;
  std::vector<Vec3> rgb;
  for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
    const float x = static_cast<float>(i % kSide), y = static_cast<float>(i / kSide);
    rgb.push_back(i % kSide % 4 < 2 ? Vec3(500 + x, 480 + y, 300 + x) : Vec3(2 + 0.01f * y, 4, 9 - 0.02f * x));
  }
  EXPECT_LT(relative_error(rgb, through(rgb, kSide, kSide)), 0.01);
}

TEST(Bc6h, WhatDoesNotCountTakesNothing) {
  std::vector<Vec3> rgb;
  std::vector<std::uint8_t> counts;
  std::mt19937 random(5);
  for (int i = 0; i < 16; ++i) {
    counts.push_back(i < 6 ? 1 : 0);
    rgb.push_back(i < 6 ? Vec3(100, 90, 80) * (1 + 0.01f * static_cast<float>(i))
                        : Vec3(random() % 60000, random() % 50, random() % 7));
  }
  const auto read = through(rgb, 4, 4, counts);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_LT(glm::length(read[i] - rgb[i]), 0.002f * glm::length(rgb[i]));
  double worst = 0;
  relative_error({rgb.begin(), rgb.begin() + 6}, through(rgb, 4, 4), &worst);
  EXPECT_GT(worst, 0.01) << "all counting it is worse";
}

TEST(Bc6h, OddSizesAndBadNumbers) {
  const float inf = std::numeric_limits<float>::infinity(), nan = std::nanf("");
  const std::vector<Vec3> rgb = {{1, 1, 1}, {nan, -1, 0}, {inf, 1e30f, 0}, {1, 1, 1}, {1, 1, 1}};
  for (const auto& [width, height] : {std::pair(5u, 1u), std::pair(1u, 5u)})
    for (const Vec3& texel : through(rgb, width, height))
      for (int c = 0; c < 3; ++c) EXPECT_TRUE(std::isfinite(texel[c]) && texel[c] >= 0);
  EXPECT_TRUE(bc6h_blocks({}, 0, 0).empty());
}

}  // namespace
}  // namespace oriel
