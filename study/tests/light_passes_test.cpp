// Fewer render passes for the same pairs of cells and lights.
#include "study/barczak2006/light_passes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

namespace oriel::study {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

std::multiset<Pair> pairs_of(const std::vector<LightPass>& elements) {
  std::multiset<Pair> out;
  for (const LightPass& e : elements)
    for (const std::uint32_t cell : e.cells)
      for (const std::uint32_t light : e.lights) out.insert({cell, light});
  return out;
}

std::vector<std::uint32_t> run(std::uint32_t from, std::uint32_t count) {
  std::vector<std::uint32_t> out(count);
  std::iota(out.begin(), out.end(), from);
  return out;
}

std::vector<LightPass> random_elements(std::mt19937& random, std::uint32_t count, std::uint32_t lights, double share) {
  std::vector<LightPass> out;
  std::bernoulli_distribution has(share);
  for (std::uint32_t i = 0; i < count; ++i) {
    LightPass e{{7 * i}, {}};
    for (std::uint32_t l = 0; l < lights; ++l)
      if (has(random)) e.lights.push_back(1000 * l + l % 3);
    out.push_back(e);
  }
  return out;
}

TEST(MergePasses, KeepsEachPairOnce) {
  std::mt19937 random(1);
  for (int i = 0; i < 60; ++i) {
    const std::uint32_t count = 1 + random() % 40, lights = 1 + random() % 150;
    const std::size_t each = 1 + random() % 9;
    auto elements = random_elements(random, count, lights, 0.05 + 0.9 * (random() % 100) / 100.0);
    std::ranges::shuffle(elements.front().lights, random);
    const auto merged = merge_passes(elements, each);
    EXPECT_EQ(pairs_of(merged), pairs_of(elements));
    EXPECT_LE(count_passes(merged, each), count_passes(elements, each));
    for (const LightPass& e : merged) {
      EXPECT_FALSE(e.cells.empty() || e.lights.empty());
      EXPECT_TRUE(std::ranges::is_sorted(e.cells) && std::ranges::is_sorted(e.lights));
    }
    // Nothing is left that would save more.
    const auto again = merge_passes(merged, each);
    EXPECT_EQ(count_passes(again, each), count_passes(merged, each));
  }
}

TEST(MergePasses, DrawsEqualsTogether) {
  std::vector<LightPass> elements;
  for (std::uint32_t i = 0; i < 20; ++i) elements.push_back({{i}, run(0, 300)});
  EXPECT_EQ(count_passes(elements, 6), 1000u);  // the thesis's example
  const auto merged = merge_passes(elements, 6);
  ASSERT_EQ(merged.size(), 1u);
  EXPECT_EQ(merged[0].cells, run(0, 20));
  EXPECT_EQ(count_passes(merged, 6), 50u);
}

TEST(MergePasses, DrawsWhatIsCommonTogether) {
  // 14 common lights of 21 each: 3 + 3 passes become 2 + 1 + 1.
  const std::vector<LightPass> elements = {{{0}, run(0, 21)}, {{1}, run(7, 21)}};
  const auto merged = merge_passes(elements, 7);
  EXPECT_EQ(count_passes(elements, 7), 6u);
  EXPECT_EQ(count_passes(merged, 7), 4u);
  EXPECT_EQ(merged.size(), 3u);
  EXPECT_EQ(pairs_of(merged), pairs_of(elements));
  // 3 common of 7: 1 + 1 would become 1 + 1 + 1.
  const std::vector<LightPass> apart = {{{0}, run(0, 7)}, {{1}, run(4, 7)}};
  EXPECT_EQ(merge_passes(apart, 7).size(), 2u);
  // All lights of one are the other's: 2 + 1 become 1 + 1.
  const std::vector<LightPass> within = {{{0}, run(0, 14)}, {{1}, run(7, 7)}};
  EXPECT_EQ(count_passes(merge_passes(within, 7), 7), 2u);
}

TEST(MergePasses, TakesWhatIsDegenerate) {
  EXPECT_TRUE(merge_passes({}, 7).empty());
  EXPECT_TRUE(merge_passes({{{1}, {}}, {{}, {2}}}, 7).empty());
  EXPECT_EQ(count_passes({}, 7), 0u);
  const std::vector<LightPass> twice = {{{1, 1}, {4, 4, 2}}, {{0}, {2}}};
  const auto merged = merge_passes(twice, 0);
  EXPECT_EQ(pairs_of(merged), (std::multiset<Pair>{{0, 2}, {1, 2}, {1, 4}}));
  EXPECT_EQ(count_passes(merged, 0), 2u);
}

}  // namespace
}  // namespace oriel::study
