// What a frame is exposed for, from blocks that are made up.
#include <gtest/gtest.h>

#include "player/passes/display_pass.h"

namespace oriel {
namespace {

constexpr int kWidth = 32, kHeight = 18;

// Of 256 pixels each, with log2 of luminance as told.
template <class Light>
std::vector<Vec4> blocks(const Light& light) {
  std::vector<Vec4> out;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) out.emplace_back(256 * light(x, y), 256.0f, 0, 0);
  return out;
}

TEST(Meter, AnEvenFrameIsItsOwnLight) {
  EXPECT_NEAR(*log_luminance_of(blocks([](int, int) { return 5.0f; }), kWidth), 5, 1e-5f);
}

TEST(Meter, DarkCornersDoNotBurnOutWhatIsLit) {
  // Two thirds of the frame are ten stops darker.
  const auto sums = blocks([](int x, int) { return x < kWidth / 3 ? 5.0f : -5.0f; });
  EXPECT_NEAR(*log_luminance_of(sums, kWidth), 5, 1e-4f);
  // Shadows of a few stops are part of the picture.
  const float some = *log_luminance_of(blocks([](int x, int) { return x < kWidth / 2 ? 5.0f : 2.0f; }), kWidth);
  EXPECT_NEAR(some, 3.5f, 0.05f);
}

TEST(Meter, TheMiddleCountsMore) {
  const auto middle = [](int x, int y) { return x > 9 && x < 22 && y > 5 && y < 12; };
  const float lit = *log_luminance_of(blocks([&](int x, int y) { return middle(x, y) ? 4.0f : 0.0f; }), kWidth);
  const float rim = *log_luminance_of(blocks([&](int x, int y) { return middle(x, y) ? 0.0f : 4.0f; }), kWidth);
  EXPECT_GT(lit, 4 * 6.0f * 12 / (kWidth * kHeight)) << "more than by area";
  EXPECT_NEAR(lit + rim, 4, 1e-4f);
}

TEST(Meter, NothingIsSeen) {
  EXPECT_FALSE(log_luminance_of(std::vector<Vec4>(std::size_t{kWidth} * kHeight, Vec4(0)), kWidth));
}

}  // namespace
}  // namespace oriel
