// Which reflectors get an image of their own.
#include "player/passes/image_budget.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace oriel {
namespace {

TEST(ImageBudget, GoesToWhatShowsMostForItsPrice) {
  const std::array<PricedImage, 4> images{{{1, 10}, {4, 20}, {1, 100}, {0, 1}}};
  const auto drawn = [&](float budget) {
    std::string out;
    for (const ImageAllowance& a : afford_images(images, budget)) out += a.drawn ? '1' : '0';
    return out;
  };
  EXPECT_EQ(drawn(0), "0000");
  EXPECT_EQ(drawn(1), "0001") << "what is cheap enough, though it shows nothing";
  EXPECT_EQ(drawn(20), "0100");
  EXPECT_EQ(drawn(30), "1100");
  EXPECT_EQ(drawn(130), "1110");
  EXPECT_EQ(drawn(std::numeric_limits<float>::infinity()), "1111");
}

TEST(ImageBudget, LeavesTheRestToImagesInThem) {
  const std::array<PricedImage, 3> images{{{3, 10}, {1, 10}, {0, 10}}};
  const auto allowed = afford_images(images, 130);
  EXPECT_FLOAT_EQ(allowed[0].within_ms, 75);
  EXPECT_FLOAT_EQ(allowed[1].within_ms, 25);
  EXPECT_EQ(allowed[2].within_ms, 0);
}

TEST(ImageBudget, DrawsWhatIsNeeded) {
  const std::array<PricedImage, 2> images{{{1, 1000, true}, {1, 1}}};
  const auto allowed = afford_images(images, 10);
  EXPECT_TRUE(allowed[0].drawn);
  EXPECT_FALSE(allowed[1].drawn) << "nothing is left";
  EXPECT_EQ(allowed[0].within_ms, 0);
}

TEST(ImageBudget, GrowsWithTheFrameAndIsLessWhileSomethingMoves) {
  EXPECT_EQ(frame_budget_ms(100, 1280, 720, false), 100);
  EXPECT_EQ(frame_budget_ms(100, 2560, 1440, false), 400);
  EXPECT_EQ(frame_budget_ms(100, 640, 360, false), 100);
  EXPECT_LT(frame_budget_ms(100, 640, 360, true), 50);
  EXPECT_TRUE(std::isinf(frame_budget_ms(std::numeric_limits<float>::infinity(), 1280, 720, true)));
}

}  // namespace
}  // namespace oriel
