// The greedy choice of viewpoints, on tables made by hand.
#include "bake/radiance/choice.h"

#include <gtest/gtest.h>

#include <limits>

namespace oriel {
namespace {

constexpr float kNotSeen = std::numeric_limits<float>::infinity();

TEST(Choice, TakesWhatShowsMostThenWhatIsNew) {
  // Candidate 0 shows samples 0 to 2, 1 shows 2 and 3, 2 shows 0 and 1, 3 shows nothing.
  const NeedTable table{
      {1, 1, 1, 1},
      {9, 9, 9, kNotSeen, kNotSeen, kNotSeen, 9, 9, 9, 9, kNotSeen, kNotSeen, kNotSeen, kNotSeen, kNotSeen, kNotSeen}};
  const Choice choice = choose_views(table, 8, 64, 4096, 0);
  ASSERT_EQ(choice.picks.size(), 2u);
  EXPECT_EQ(choice.picks[0].candidate, 0u);
  EXPECT_EQ(choice.picks[1].candidate, 1u);
  EXPECT_EQ(choice.picks[0].gain, 3 * 9) << "holes count eight times, blur once";
  EXPECT_EQ(choice.picks[1].gain, 9);
  EXPECT_EQ(choice.seen(), 1);
  EXPECT_EQ(choice.sharp(), 1);
  EXPECT_EQ(choose_views(table, 1, 64, 4096, 0).seen(), 0.75);
}

TEST(Choice, HeavySamplesComeFirstAndTiesGoToTheLowerNumber) {
  const NeedTable table{{1, 1, 5}, {9, 9, kNotSeen, kNotSeen, kNotSeen, 9, kNotSeen, kNotSeen, 9}};
  const Choice choice = choose_views(table, 8, 64, 4096, 0);
  ASSERT_EQ(choice.picks.size(), 2u);
  EXPECT_EQ(choice.picks[0].candidate, 1u);
  EXPECT_EQ(choice.picks[1].candidate, 0u);
}

TEST(Choice, AMapIsPickedWhileItShowsMoreThanItsPixelsCost) {
  const NeedTable table{
      {1, 1, 1, 1},
      {9, 9, 9, kNotSeen, kNotSeen, kNotSeen, 9, 9, 9, 9, kNotSeen, kNotSeen, kNotSeen, kNotSeen, kNotSeen, kNotSeen}};
  EXPECT_EQ(choose_views(table, 8, 64, 4096, 8.9 / 4096).picks.size(), 2u);
  EXPECT_EQ(choose_views(table, 8, 64, 4096, 9.1 / 4096).picks.size(), 1u);
  EXPECT_EQ(choose_views(table, 8, 64, 4096, 27.1 / 4096).picks.size(), 0u);
}

TEST(Choice, TheResolutionIsThatOfTheMostValue) {
  // One candidate needs 200 pixels for all; two others 60 for half each.
  const NeedTable table{{1, 1}, {200, 200, 60, kNotSeen, kNotSeen, 60}};
  const auto at = [&](double price) {
    std::vector<Choice> choices;
    for (const std::uint32_t side : {16u, 64u, 256u})
      choices.push_back(choose_views(table, 8, side, side * side, price));
    return best_value(choices, price);
  };
  // By hand: the first at 16², 16 of weight 18 for 256 pixels; all three at 64², all 18 for 12 288.
  EXPECT_EQ(at(1e-6).resolution, 64u);
  EXPECT_EQ(at(1e-6).picks.size(), 3u);
  EXPECT_EQ(at(1e-6).sharp(), 1);
  EXPECT_EQ(at(1e-3).resolution, 16u) << "what is sharper costs more than it shows";
  EXPECT_EQ(at(1e-3).seen(), 1);
  EXPECT_EQ(at(1e-3).sharp(), 0);
  EXPECT_TRUE(at(1).picks.empty()) << "nothing is worth that";
  // Dearer pixels, of maps that were picked at a lower price.
  std::vector<Choice> choices{choose_views(table, 8, 64, 4096, 1e-6)};
  EXPECT_EQ(best_value(choices, 1e-6).picks.size(), 3u);
  EXPECT_EQ(best_value(choices, 1e-3).picks.size(), 1u);
  EXPECT_TRUE(choose_views({}, 8, 64, 4096, 0).picks.empty());
}

}  // namespace
}  // namespace oriel
