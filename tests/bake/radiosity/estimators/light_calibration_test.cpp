// Lamps of which a neighbourhood sees all, or nothing, get no further shadow rays, and faint ones few.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bake/radiosity/estimators/direct_group.h"
#include "tests/bake/radiosity/listed.h"

namespace oriel::test {
namespace {

// A floor of 3 m under two lamps; a board hides one of them from all of it. points: they have no size.
Scene two_lamps(bool board, bool points = false) {
  SceneParts parts;
  const auto matt = parts.diffuse(Vec3(0.5f));
  parts.quad("floor", matt, {0, 0, 0}, {0, 0, 3}, {3, 0, 0});
  for (const float height : {2.5f, 4.0f})
    if (points) {
      Light& light = parts.scene().lights.emplace_back();
      light.position = {1.5f, height, 1.5f}, light.intensity = Vec3(100);
    } else {
      parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(100)), {1, height, 1}, {1, 0, 0}, {0, 0, 1});
    }
  if (board) parts.box("board", matt, {-9, 3, -9}, {12, 3.2f, 12});
  return parts.finish();
}

struct Lit {
  explicit Lit(Scene scene) : listed(std::move(scene), 0.1f) {}

  DirectSums direct(std::uint32_t per_half) { return direct(per_half, listed.floor); }
  DirectSums direct(std::uint32_t per_half, std::span<const std::uint32_t> list) {
    DirectSums sums(listed.texels.count(), false);
    rays = 0;
    const DirectLight light(transport, listed.texels, sample_points, 1);
    EXPECT_TRUE(light.estimate(list, per_half, {listed.context, &rays}, sums));
    return sums;
  }

  Listed listed;
  std::atomic<std::uint64_t> rays{0};
  const Transport transport = listed.transport();
  const ExtraSamplePoints sample_points = listed.sample_points(transport);
};

TEST(LightCalibration, TellsWhatIsSeenWhollyOrNotAtAll) {
  Lit lit(two_lamps(true));
  const DirectSums few = lit.direct(2);
  const std::uint64_t rays = lit.rays;
  const DirectSums many = lit.direct(8);
  // One ray a half finds a further point of the texel. Shadow rays to both lamps are twelve more, in the last group,
  // which is of few texels.
  EXPECT_LT(lit.rays, rays + 2 * 2 * lit.listed.floor.size());
  for (const std::uint32_t i : lit.listed.floor) {
    if (lit.listed.texels.visible[i] < 1) continue;
    EXPECT_GT(many.value[i].g, 0);
    EXPECT_NEAR(many.value[i].g, few.value[i].g, 0.05 * few.value[i].g) << "a texel's mean, of more points";
    EXPECT_EQ(many.variance[i], Vec3(0));
  }
}

TEST(LightCalibration, IsOfPointsToo) {
  Lit lit(two_lamps(true, true));
  const DirectSums few = lit.direct(2);
  const std::uint64_t rays = lit.rays;
  const DirectSums many = lit.direct(8);
  // Rays find further points of the texel, four a half. Shadow rays to both lamps are twelve more, in the last group,
  // which is of few texels.
  EXPECT_LT(lit.rays, rays + 2 * 5 * lit.listed.floor.size());
  for (const std::uint32_t i : lit.listed.floor)
    EXPECT_NEAR(many.value[i].g, few.value[i].g, 0.05 * few.value[i].g) << "a texel's mean, of more points";
}

// A texel's own few samples may agree by chance.
TEST(LightCalibration, IsOfManyTexels) {
  Lit lit(two_lamps(true, true));
  const DirectSums all = lit.direct(2);
  const auto is_lit = [&](std::uint32_t i) { return all.value[i].g > 0 && lit.listed.texels.visible[i] == 1; };
  const std::array one{*std::ranges::find_if(lit.listed.floor, is_lit)};
  (void)lit.direct(2, one);
  EXPECT_EQ(lit.rays, 2u * 2 * 2) << "a half, point and lamp";
  (void)lit.direct(8, one);
  EXPECT_EQ(lit.rays, 2u * (8 * 2 + 4)) << "all of them, and those that find further points";
}

// The upper lamp shines through the rim of the lower one's shadow: there all samples are traced.
TEST(LightCalibration, LeavesPenumbraeToAllSamples) {
  Lit lit(two_lamps(false));
  (void)lit.direct(2);
  const std::uint64_t rays = lit.rays;
  (void)lit.direct(8);
  EXPECT_GT(lit.rays, 2 * rays);
}

TEST(LightCalibration, SharesSamplesOutByWhatTheyTakeOffTheVariance) {
  EXPECT_EQ(sample_count(1, 1, 32), 32u) << "the noisiest";
  EXPECT_EQ(sample_count(std::pow(2.0f, -2.4f), 1, 32), 32u);
  EXPECT_EQ(sample_count(std::pow(2.0f, -2.6f), 1, 32), 16u)
      << "a half of the samples: 2^2.5 times as much to gain from one more";
  EXPECT_EQ(sample_count(0, 1, 32), 4u) << "at least";
}

// A floor of 3 m on which boards cast soft shadows of two lamps.
Scene lamps_over_boards(float faint) {
  SceneParts parts;
  const auto matt = parts.diffuse(Vec3(0.5f));
  parts.quad("floor", matt, {0, 0, 0}, {0, 0, 3}, {3, 0, 0});
  parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(100)), {0, 2.5f, 1}, {1, 0, 0}, {0, 0, 1});
  parts.quad("faint lamp", parts.diffuse(Vec3(0), Vec3(faint)), {2, 2.5f, 1}, {1, 0, 0}, {0, 0, 1});
  for (int k = 0; k < 3; ++k) {
    const float x = static_cast<float>(k) + 0.3f;
    parts.box("board", matt, {x, 1, 0}, {x + 0.4f, 1.1f, 3});
  }
  return parts.finish();
}

TEST(LightCalibration, GivesFaintLampsFewerRaysForTheSameLight) {
  Lit bright(lamps_over_boards(100)), faint(lamps_over_boards(1));
  (void)bright.direct(32);
  const std::uint64_t rays = bright.rays;
  const DirectSums some = faint.direct(32);
  EXPECT_LT(faint.rays, 3 * rays / 4);
  const DirectSums truth = faint.direct(512);
  double light = 0, expected = 0, squares = 0, stated = 0;
  for (const std::uint32_t i : faint.listed.floor) {
    light += double{some.value[i].g}, expected += double{truth.value[i].g};
    squares += std::pow(double{some.value[i].g - truth.value[i].g}, 2);
    stated += double{some.variance[i].g} + double{some.uneven[i].g};
  }
  EXPECT_NEAR(light, expected, 3 * std::sqrt(squares)) << "texels' errors are independent";
  EXPECT_LT(squares, 2 * stated) << "the error is stated";
  EXPECT_GT(squares, 0.1 * stated);
}

}  // namespace
}  // namespace oriel::test
