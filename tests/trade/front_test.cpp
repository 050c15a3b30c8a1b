#include "trade/front.h"

#include <gmock/gmock.h>

#include <limits>
#include <random>

namespace oriel::trade {
namespace {
using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(Front, HoldsWhatNothingBeatsInBoth) {
  const std::vector<CostError> points{{3, 1}, {1, 4}, {2, 2}, {2.5, 3}, {4, 1.5}};
  EXPECT_THAT(pareto_front(points), ElementsAre(1, 2, 0));
}

TEST(Front, OfEqualPointsHoldsTheFirst) {
  EXPECT_THAT(pareto_front(std::vector<CostError>{{1, 1}, {1, 1}}), ElementsAre(0));
  EXPECT_THAT(pareto_front(std::vector<CostError>{{1, 2}, {1, 1}}), ElementsAre(1)) << "as cheap, and better";
  EXPECT_THAT(pareto_front(std::vector<CostError>{{2, 1}, {1, 1}}), ElementsAre(1)) << "as good, and cheaper";
}

TEST(Front, LeavesOutWhatIsNoNumber) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();
  EXPECT_THAT(pareto_front({}), IsEmpty());
  EXPECT_THAT(pareto_front(std::vector<CostError>{{kNan, 0}, {0, kNan}, {kInf, 0}, {5, 5}}), ElementsAre(3));
}

// Points on the hyperbola cost · error = 1 are all on the front, those above it are not.
TEST(Front, IsTheHyperbolaUnderACloud) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<CostError> points;
  for (int i = 0; i < 50; ++i) points.push_back({1.0 + i, 1.0 / (1.0 + i)});
  for (int i = 0; i < 500; ++i) {
    const double cost = 1 + 49 * unit(random);
    points.push_back({cost, 1.0 / std::floor(cost) + unit(random)});
  }
  const auto front = pareto_front(points);
  ASSERT_EQ(front.size(), 50u);
  for (std::size_t i = 0; i < front.size(); ++i) EXPECT_EQ(front[i], i);
}

TEST(Front, KindsReadTheirMeasures) {
  Measures m;
  for (const FrontKind& kind : front_kinds()) EXPECT_FALSE(kind.cost_of(m) && kind.error_of(m)) << kind.id;
  m.bake = BakeCost{2, 3, 4'000'000};
  m.frame_ms = 16;
  m.texels = TexelError{10, 0.25, 0.125, 0, 0};
  m.frames = {{"a", 0.3, 0, {}, 0, 0, 0}, {"b", 0.4, 0, {}, 0, 0, 0}};
  const auto kinds = front_kinds();
  EXPECT_EQ(kinds[0].cost_of(m), 2);
  EXPECT_EQ(kinds[0].error_of(m), 0.25);
  EXPECT_DOUBLE_EQ(*kinds[1].error_of(m), std::sqrt((0.09 + 0.16) / 2));
  EXPECT_EQ(kinds[2].cost_of(m), 16);
  EXPECT_EQ(kinds[3].cost_of(m), 4);
}

}  // namespace
}  // namespace oriel::trade
