// Which images are kept, how fine, in which order.
#include "player/images/residency.h"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <random>

#include "player/images/background.h"
#include "player/images/loading_watch.h"

namespace oriel {
namespace {

using namespace std::chrono_literals;

std::uint64_t bytes_of(const std::vector<Wish>& wishes, const std::vector<int>& levels) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < wishes.size(); ++i)
    if (levels[i] < wishes[i].out()) sum += wishes[i].bytes[static_cast<std::size_t>(levels[i])];
  return sum;
}

TEST(Residency, WithoutALimitAllIsAsFineAsItIs) {
  EXPECT_TRUE(plan_residency({}, kNoLimit).empty());
  const std::vector<Wish> wishes{{{1ull << 40, 10}, 3}, {{100, 25, 6}, 1}, {{5}, 2}};
  EXPECT_EQ(plan_residency(wishes, kNoLimit), (std::vector<int>{0, 0, 0}));
}

TEST(Residency, TheNearestIsWholeFirstAndAllAreThereBeforeAnyGetsFiner) {
  const std::vector<Wish> wishes{{{64, 16, 4}, 2}, {{64, 16, 4}, 0}, {{64, 16, 4}, 1}};
  EXPECT_EQ(plan_residency(wishes, 192), (std::vector<int>{0, 0, 0}));
  EXPECT_EQ(plan_residency(wishes, 191), (std::vector<int>{1, 0, 0}));
  EXPECT_EQ(plan_residency(wishes, 84), (std::vector<int>{2, 0, 1}));
  EXPECT_EQ(plan_residency(wishes, 83), (std::vector<int>{2, 0, 2}));
  EXPECT_EQ(plan_residency(wishes, 72), (std::vector<int>{2, 0, 2}));
  EXPECT_EQ(plan_residency(wishes, 71), (std::vector<int>{1, 1, 1}));
  EXPECT_EQ(plan_residency(wishes, 47), (std::vector<int>{2, 1, 1}));
  EXPECT_EQ(plan_residency(wishes, 12), (std::vector<int>{2, 2, 2}));
  EXPECT_EQ(plan_residency(wishes, 11), (std::vector<int>{3, 2, 2})) << "the farthest is left out";
  EXPECT_EQ(plan_residency(wishes, 3), (std::vector<int>{3, 3, 3}));
  EXPECT_EQ(plan_residency(wishes, 0), (std::vector<int>{3, 3, 3}));
}

TEST(Residency, OfEqualOnesTheFirst) {
  const std::vector<Wish> wishes(3, Wish{{10, 1}, 5});
  EXPECT_EQ(plan_residency(wishes, 12), (std::vector<int>{0, 1, 1}));
}

// Random wishes: never above the limit, and nothing that would have fitted is left coarser.
TEST(Residency, NeverAboveTheLimitAndNothingIsWasted) {
  std::mt19937 random(7);
  const auto below = [&](std::uint64_t n) { return std::uniform_int_distribution<std::uint64_t>(0, n - 1)(random); };
  int full = 0, coarse = 0, out = 0;
  for (int round = 0; round < 2000; ++round) {
    std::vector<Wish> wishes(1 + below(12));
    std::uint64_t all = 0;
    for (Wish& wish : wishes) {
      wish.rank = static_cast<float>(below(5));
      std::uint64_t bytes = 1 + below(10000);
      all += bytes;
      for (std::uint64_t levels = 1 + below(5); levels > 0; --levels, bytes = bytes / 4 + 1)
        wish.bytes.push_back(bytes);
    }
    const std::uint64_t limit = below(all + all / 4 + 1);
    const std::vector<int> levels = plan_residency(wishes, limit);
    const std::uint64_t used = bytes_of(wishes, levels);
    ASSERT_LE(used, limit);
    for (std::size_t i = 0; i < wishes.size(); ++i) {
      const int level = levels[i];
      (level == 0 ? full : level < wishes[i].out() ? coarse : out) += 1;
      if (level == 0) continue;
      const std::uint64_t has = level < wishes[i].out() ? wishes[i].bytes[static_cast<std::size_t>(level)] : 0;
      if (level < wishes[i].out()) {
        EXPECT_GT(wishes[i].bytes[static_cast<std::size_t>(level - 1)] - has, limit - used) << "a finer one had room";
      }
    }
  }
  EXPECT_GT(full, 1000);
  EXPECT_GT(coarse, 1000);
  EXPECT_GT(out, 100);
}

TEST(Residency, AnAccountHoldsItsLimit) {
  MemoryAccount account(100);
  EXPECT_TRUE(account.take(60));
  EXPECT_FALSE(account.take(41));
  EXPECT_EQ(account.used(), 60u);
  EXPECT_TRUE(account.take(40));
  account.give_back(70);
  EXPECT_EQ(account.used(), 30u);
  EXPECT_EQ(account.most_used(), 100u);
  EXPECT_FALSE(account.has_room(kNoLimit));
  MemoryAccount free;
  EXPECT_TRUE(free.take(1ull << 62) && free.take(1ull << 62));
}

Bounds box(const Vec3& lower, float side) {
  Bounds out;
  out.extend(lower);
  out.extend(lower + Vec3(side));
  return out;
}

TEST(Residency, WhatIsNearAndInViewMattersMost) {
  const Vec3 eye(0);
  const auto at = [&](float distance, bool in_view = true, bool seen = true) {
    return rank_of(box({distance, -1, -1}, 2), eye, in_view, seen);
  };
  EXPECT_EQ(at(-1), 0) << "around the eye";
  EXPECT_EQ(at(0.4f), 0);
  for (float d = 1; d < 1000; d *= 2) EXPECT_EQ(at(2 * d), at(d) + 2);
  EXPECT_EQ(at(10), at(10.2f)) << "a small move changes nothing";
  EXPECT_EQ(at(8, false), at(64)) << "behind: as eight times as far";
  EXPECT_EQ(at(8, true, false), at(128));
  EXPECT_LT(at(1, false, false), at(100, false, false));
}

TEST(Background, DoesJobsInOrderAndIsWaitedFor) {
  std::vector<int> done;
  Background background(1, true);
  for (int i = 0; i < 100; ++i) background.add([&, i] { done.push_back(i); });
  background.wait_below(1, std::chrono::steady_clock::time_point::max());
  EXPECT_EQ(background.unfinished(), 0u);
  std::vector<int> expected(100);
  std::iota(expected.begin(), expected.end(), 0);
  EXPECT_EQ(done, expected);
}

TEST(Background, SeveralThreadsDoEachJobOnce) {
  std::vector<int> done(1000);
  Background background(4, false);
  for (int& job : done) background.add([&job] { ++job; });
  background.wait_below(1, std::chrono::steady_clock::time_point::max());
  EXPECT_EQ(done, std::vector<int>(1000, 1));
}

TEST(Background, EndsWithTheJobThatRuns) {
  constexpr int kJobs = 100'000;  // half an hour of them: no machine ends them before it is told to stop
  std::atomic<int> begun{0}, ended{0};
  {
    Background background(1, true);
    for (int i = 0; i < kJobs; ++i)
      background.add([&] {
        ++begun;
        std::this_thread::sleep_for(20ms);
        ++ended;
      });
    while (begun == 0) std::this_thread::sleep_for(1ms);
    const auto start = std::chrono::steady_clock::now();
    background.wait_below(1, start + 5ms);  // gives up
    EXPECT_GT(background.unfinished(), 0u);
  }
  EXPECT_EQ(begun, ended);
  EXPECT_LT(begun, kJobs);
}

TEST(LoadingWatch, TellsOnceWhatItTook) {
  const LoadingWatch::Clock::time_point start{};
  LoadingWatch watch(start);
  EXPECT_FALSE(watch.news());
  watch.frame(start + 500ms, true);
  watch.frame(start + 520ms, true);
  EXPECT_FALSE(watch.news());
  watch.frame(start + 590ms, true);
  watch.frame(start + 600ms, false);
  watch.frame(start + 5s, true);  // later ones do not count
  EXPECT_EQ(watch.news(), "first frame after 0.50 s, all images after 0.60 s in 4 frames, the longest of 70 ms");
  EXPECT_FALSE(watch.news());
}

}  // namespace
}  // namespace oriel
