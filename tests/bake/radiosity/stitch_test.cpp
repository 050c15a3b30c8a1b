// The least squares of stitching on pages made by hand.
#include "bake/radiosity/stitch.h"

#include <gtest/gtest.h>

namespace oriel {
namespace {

constexpr std::uint32_t kSide = 4;

// Two pages of one value each, all of it baked, that meet along their first columns at the texels' centres.
struct TwoPages {
  std::vector<LightmapPage> pages;
  std::vector<TexelMapPage> map;
  Seams seams;

  TwoPages(const Vec3& a, const Vec3& b, float error_a, float error_b) {
    for (const auto& [light, error] : {std::pair{a, error_a}, {b, error_b}}) {
      pages.push_back({kSide, kSide, std::vector<Vec3>(kSide * kSide, light),
                       std::vector<Vec3>(kSide * kSide, Vec3(error)),
                       std::vector<TexelState>(kSide * kSide, TexelState::kValid)});
      TexelMapPage page{kSide, kSide, {}, {0}, {}};
      for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
        page.texel.push_back(i);
        page.fragments.push_back({0, 1.0f});
        page.first.push_back(i + 1);
      }
      map.push_back(page);
    }
    for (std::uint32_t y = 0; y < kSide; ++y)
      seams.points.push_back({{0, 1}, {DVec2(0.5, y + 0.5), DVec2(0.5, y + 0.5)}, 1});
    seams.pairs = 1;
  }
};

// One texel a side and point: both move in proportion to their squared errors until they meet.
TEST(Stitch, TexelsMoveByTheirSquaredErrors) {
  TwoPages two(Vec3(1), Vec3(1.2f), 0.05f, 0.1f);
  const SeamReport report = stitch(two.seams, two.map, 1, two.pages);
  const double light = 1.1 + 0.01 * 1.1;  // of the place: both sides, and 1 % of the mean
  const auto squared_error = [](double noise, double own) { return noise * noise + std::pow(0.01 * (own + 0.011), 2); };
  const double a = squared_error(0.05, 1), b = squared_error(0.1, 1.2);  // a texel is 1 % off anyhow
  const double up = two.pages[0].irradiance[0].g - 1, down = 1.2 - two.pages[1].irradiance[0].g;
  EXPECT_NEAR(up / down, a / b, 1e-4);
  EXPECT_NEAR(up + down, 0.2, 0.2 * 0.01);
  EXPECT_NEAR(report.max_step_before, 0.2 / light, 1e-6);
  EXPECT_LT(report.max_step, 0.01 * report.max_step_before);
  EXPECT_EQ(two.pages[0].irradiance[1], Vec3(1)) << "the seam does not read the second column";
}

TEST(Stitch, ChangesNothingWithoutTime) {
  TwoPages two(Vec3(1), Vec3(1.2f), 0.05f, 0.1f);
  const SeamReport report = stitch(two.seams, two.map, 1, two.pages, [] { return 0.0; });
  EXPECT_TRUE(report.late);
  EXPECT_EQ(report.pairs, 0u);
  EXPECT_EQ(two.pages[0].irradiance[0], Vec3(1));
  EXPECT_FALSE(stitch(two.seams, two.map, 1, two.pages, [] { return 60.0; }).late);
}

// Such as the inside of a crack that shares an edge with a lit wall: what is certainly dark is not torn towards the
// light.
TEST(Stitch, ADarkTexelBesideABrightOneStaysDark) {
  TwoPages two(Vec3(1), Vec3(100), 0.01f, 20);
  (void)stitch(two.seams, two.map, 1, two.pages);
  EXPECT_LE(two.pages[0].irradiance[0].g, 1.34f);
  EXPECT_GE(two.pages[1].irradiance[0].g, 65) << "nor is the lit one";
}

// What is mended at a seam is an error beside it: no more of that than is allowed, but all of it goes into the seam.
TEST(Stitch, MovesByNoMoreThanAllowed) {
  double last = 0;
  for (const double at_most : {1.0, 0.02, 0.005}) {
    TwoPages two(Vec3(1), Vec3(1.2f), 0.1f, 0.1f);
    const SeamReport report = stitch(two.seams, two.map, at_most, two.pages);
    double squares = 0;
    for (const Vec3& e : two.pages[0].irradiance) squares += std::pow((e.g - 1) / e.g, 2);
    for (const Vec3& e : two.pages[1].irradiance) squares += std::pow((e.g - 1.2) / 1.2, 2);
    const double moved = std::sqrt(squares / (2 * kSide * kSide));
    EXPECT_LE(moved, at_most);
    if (at_most < 0.04) {
      EXPECT_GE(moved, 0.3 * at_most);  // without it 4.4 %
    }
    EXPECT_GT(report.mean_step, last) << "the dearer, the larger the step that is left";
    EXPECT_LT(report.mean_step, report.mean_step_before);
    last = report.mean_step;
  }
}

TEST(Stitch, DarkPlacesAreTreatedAsBrightOnes) {
  for (const float scale : {1e-12f, 1e12f}) {
    TwoPages one(Vec3(1), Vec3(1.2f), 0.05f, 0.1f), other(Vec3(scale), Vec3(1.2f * scale), 0.05f * scale, 0.1f * scale);
    stitch(one.seams, one.map, 1, one.pages);
    stitch(other.seams, other.map, 1, other.pages);
    EXPECT_NEAR(other.pages[0].irradiance[0].r / scale, one.pages[0].irradiance[0].r, 1e-5);
  }
}

TEST(Stitch, ChannelsAreStitchedAlike) {
  TwoPages two({1, 0, 0.5f}, {1.2f, 0, 0.5f}, 0.1f, 0.1f);
  stitch(two.seams, two.map, 1, two.pages);
  EXPECT_NEAR(two.pages[0].irradiance[0].r, 1.1f, 1e-3);
  EXPECT_EQ(two.pages[0].irradiance[0].g, 0);
  EXPECT_NEAR(two.pages[0].irradiance[0].b, 0.5f, 1e-6);
}

TEST(Stitch, EmptyAndBlackPagesAreLeftAlone) {
  TwoPages black(Vec3(0), Vec3(0), 0, 0), empty(Vec3(1), Vec3(2), 0, 0);
  EXPECT_EQ(stitch(black.seams, black.map, 1, black.pages).pairs, 0u);
  EXPECT_EQ(black.pages[0].irradiance[0], Vec3(0));
  for (std::uint32_t i = 0; i < kSide; ++i) empty.pages[1].state[i * kSide] = TexelState::kEmpty;
  EXPECT_EQ(stitch(empty.seams, empty.map, 1, empty.pages).pairs, 0u);
  EXPECT_EQ(empty.pages[0].irradiance[0], Vec3(1));
}

// A texel against a black one that only a steep slope could make meet: held at zero, never below.
TEST(Stitch, NoTexelBecomesNegative) {
  TwoPages two(Vec3(1), Vec3(0.01f), 0.5f, 0.001f);
  for (SeamPoint& p : two.seams.points) p.place[0].x = 0.9;  // mostly the first column, some of the second
  for (std::uint32_t y = 0; y < kSide; ++y) {
    two.pages[0].irradiance[y * kSide] = Vec3(1e-3f);
    two.pages[0].state[y * kSide + 1] = TexelState::kDilated;
  }
  stitch(two.seams, two.map, 1, two.pages);
  for (const LightmapPage& page : two.pages)
    for (const Vec3& e : page.irradiance) EXPECT_TRUE(is_finite(e) && e.r >= 0 && e.g >= 0 && e.b >= 0);
}

}  // namespace
}  // namespace oriel
