// Loops of units that end early.
#include "bake/jobs/units.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace oriel {
namespace {

// What is there of a loop that ended early is everywhere, and says nothing of where it began.
TEST(UnitLoops, EarlyEndsLeaveGapsAllOver) {
  Context context;
  context.threads = 1;
  std::vector<int> done(1000, 0);
  std::size_t count = 0;
  UnitLoop loop{.stage = "parts", .count = done.size()};
  loop.compute = [&](std::size_t i) { return ++count, done[i] = 1, 0; };
  const auto all = done_in_time(
      context, [&] { return count >= 100; }, [&] { return parallel_units(context, loop); });
  ASSERT_TRUE(all);
  EXPECT_FALSE(*all);
  EXPECT_EQ(count, 100u);
  std::size_t gap = 0, longest = 0;
  for (const int one : done) longest = std::max(longest, gap = one ? 0 : gap + 1);
  EXPECT_LE(longest, 100u) << "900 of a loop in its order, 10 on the mean";
  ASSERT_TRUE(parallel_units(context, loop));
  EXPECT_EQ(std::ranges::count(done, 1), 1000);
}

}  // namespace
}  // namespace oriel
