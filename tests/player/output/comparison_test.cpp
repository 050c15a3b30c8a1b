// Pictures in frames of other sizes, split pictures.
#include <gtest/gtest.h>

#include "player/output/fit_picture.h"
#include "player/output/split.h"
#include "player/session/comparison.h"

namespace oriel {
namespace {

// Red grows to the right, green downwards, both linear; blue is constant.
FloatImage ramp(std::uint32_t width, std::uint32_t height) {
  FloatImage out{width, height, 3, {}};
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) {
      const Vec2 at = (Vec2(x, y) + 0.5f - 0.5f * Vec2(width, height)) / static_cast<float>(height);
      out.pixels.insert(out.pixels.end(), {at.x, at.y, 7.0f});
    }
  return out;
}

TEST(FitPicture, OneSizeGivesTheSameValues) {
  const FloatImage picture = ramp(7, 5), fit = fit_picture(picture, 7, 5, 2);
  ASSERT_EQ(fit.channels, 4u);
  for (std::size_t i = 0; i < 35; ++i) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(fit.pixels[4 * i + c], picture.pixels[3 * i + c]);
    EXPECT_EQ(fit.pixels[4 * i + 3], 2);
  }
}

// A linear ramp over the image plane keeps its values there, whatever the frame's size; beside the picture is nothing.
TEST(FitPicture, KeepsPlacesOnTheImagePlane) {
  const FloatImage picture = ramp(64, 32);
  for (const UVec2& size : {UVec2(32, 16), UVec2(16, 16), UVec2(31, 8), UVec2(100, 16)}) {
    const FloatImage fit = fit_picture(picture, size.x, size.y, 1), expected = ramp(size.x, size.y);
    for (std::size_t y = 0; y < size.y; ++y)
      for (std::size_t x = 0; x < size.x; ++x) {
        const std::size_t i = y * size.x + x;
        const float left = expected.pixels[3 * i] - 0.5f / static_cast<float>(size.y);
        const float right = left + 1 / static_cast<float>(size.y);
        if (left >= -1 && right <= 1) {
          EXPECT_NEAR(fit.pixels[4 * i], expected.pixels[3 * i], 1e-5) << size.x << "x" << size.y << " at " << x;
          EXPECT_NEAR(fit.pixels[4 * i + 1], expected.pixels[3 * i + 1], 1e-5);
          EXPECT_FLOAT_EQ(fit.pixels[4 * i + 2], 7);
          EXPECT_EQ(fit.pixels[4 * i + 3], 1);
        } else if (right <= -1 || left >= 1) {
          EXPECT_EQ(fit.pixels[4 * i + 3], 0);
        }
      }
  }
  const FloatImage large = fit_picture(ramp(2, 1), 200, 100, 1);
  EXPECT_EQ(large.pixels[0], -0.5f) << "enlarged, a pixel keeps its value";
}

TEST(Split, TakesEachSideFromItsOwn) {
  ByteImage left{4, 2, 3, std::vector<std::uint8_t>(24, 1)}, right{4, 2, 3, std::vector<std::uint8_t>(24, 2)};
  for (const auto& [divider, column] : {std::pair(0.0f, 0), {0.25f, 1}, {0.5f, 2}, {1.0f, 4}, {-3.0f, 0}, {9.0f, 4}}) {
    EXPECT_EQ(split_column(divider, 4), column);
    const ByteImage both = join_split(left, right, divider);
    for (int i = 0; i < 24; ++i)
      EXPECT_EQ(both.pixels[static_cast<std::size_t>(i)], i / 3 % 4 < column ? 1 : 2) << divider << " at " << i;
  }
  EXPECT_EQ(split_column(std::nanf(""), 4), 2);
}

TEST(Divider, IsDraggedFromWhereItIsTaken) {
  ComparisonView c;
  EXPECT_FALSE(drag_divider({0.5f, 0.5f}, true, true, 0.01f, c)) << "there is nothing to compare";
  c.second = "b.oriel";
  EXPECT_FALSE(drag_divider({0.6f, 0.5f}, true, true, 0.01f, c));
  EXPECT_TRUE(drag_divider({0.505f, 0.5f}, true, true, 0.01f, c));
  EXPECT_FALSE(drag_divider({0.8f, 0.5f}, false, true, 0.01f, c));
  EXPECT_EQ(c.divider, 0.8f);
  drag_divider({3, 0.5f}, false, true, 0.01f, c);
  EXPECT_EQ(c.divider, 1.0f);
  drag_divider({0.2f, 0.5f}, false, false, 0.01f, c);
  EXPECT_EQ(c.divider, 1.0f) << "let go";
  c.beside = Beside::kFirst;
  EXPECT_FALSE(drag_divider({1, 0.5f}, true, true, 0.01f, c)) << "it is not seen";
}

}  // namespace
}  // namespace oriel
