// Which texels are refined.
#include "bake/radiosity/estimators/worst.h"

#include <gtest/gtest.h>

#include <numeric>

#include "bake/radiosity/estimators/light_component.h"
#include "tests/bake/radiosity/listed.h"

namespace oriel {
namespace {

// Texels without neighbours, equally seen and bad, with 4 samples each.
struct Alike {
  TexelGraph graph;
  std::vector<std::uint32_t> order;
  std::vector<float> squares, importance;
  std::vector<std::uint32_t> samples;
  Context context;

  explicit Alike(std::size_t n) : order(n), squares(n, 0.04f), importance(n, 1), samples(n, 4) {
    std::iota(order.begin(), order.end(), 0u);
    graph.neighbour.resize(n), graph.count.assign(n, 0);
  }
  std::vector<std::uint32_t> worst(const WorstOptions& options) {
    return worst_texels(graph, order, {squares, importance, samples}, options, context);
  }
};

TEST(WorstTexels, AreThoseThatGainMostForTheirRays) {
  Alike a(4);
  a.importance[0] *= 0.2f, a.squares[0] *= 0.2f;  // little seen
  a.samples[1] = 64;                              // dear
  a.squares[2] = 0.02f;                           // better
  // What refining one whole texel takes away is 0.02, of the little seen one 0.004.
  EXPECT_EQ(a.worst({.goal = 0.01, .excess = 0.015}), (std::vector<std::uint32_t>{3}));
  EXPECT_EQ(a.worst({.goal = 0.01, .excess = 0.025}), (std::vector<std::uint32_t>{2, 3}));
  EXPECT_EQ(a.worst({.goal = 0.01, .excess = 0.032}), (std::vector<std::uint32_t>{0, 2, 3}));
  EXPECT_EQ(a.worst({.goal = 0.01, .excess = 1}), (std::vector<std::uint32_t>{0, 1, 2, 3}));
}

TEST(WorstTexels, AreNotThoseThatAreTwiceAsGoodAsAsked) {
  Alike a(3);
  a.squares[1] = 0.04f / 4.1f;
  EXPECT_EQ(a.worst({.goal = 0.04, .excess = 1}), (std::vector<std::uint32_t>{0, 2}));
  EXPECT_TRUE(a.worst({.goal = 0.2, .excess = 1}).empty());
}

TEST(LittleSeen, AreThoseThatTogetherFillLittle) {
  const std::vector<float> importance = {0.5f, 0.002f, 0, 0.001f, 0.497f};
  const std::vector<std::uint32_t> all = {0, 1, 2, 3, 4};
  EXPECT_EQ(little_seen(all, importance, 0.0035), (std::vector<bool>{false, true, true, true, false}));
  EXPECT_EQ(little_seen(all, importance, 0.0025), (std::vector<bool>{false, false, true, true, false}));
  EXPECT_EQ(little_seen(all, importance, 0), std::vector<bool>(5)) << "no error was asked for: all count";
}

// On a ball of texels as large as half its radius none continues another, and none would be refined for what its
// neighbours tell: those that few pixels happened to show kept their first eight rays.
TEST(ChartNeighbours, AreThereHoweverASurfaceBends) {
  test::SceneParts parts;
  parts.sphere("ball", parts.diffuse(Vec3(0.5f)), Vec3(0), 1, 3);
  const test::Listed ball(parts.finish(), 0.6f);
  Context context;
  const TexelGraph graph = *find_neighbours(ball.transport(), ball.texels, context);
  const TexelGraph beside = with_chart_neighbours(graph, ball.texels);
  std::size_t alone = 0, alone_beside = 0;
  for (std::uint32_t i = 0; i < ball.texels.count(); ++i) {
    alone += graph.count[i] == 0, alone_beside += beside.count[i] == 0;
    EXPECT_TRUE(std::ranges::equal(graph.of(i), beside.of(i).first(graph.count[i]))) << i;
    for (const std::uint32_t j : beside.of(i)) {
      const auto back = beside.of(j);
      EXPECT_NE(std::ranges::find(back, i), back.end()) << i << " and " << j;
      EXPECT_EQ(std::ranges::count(beside.of(i), j), 1);
    }
  }
  EXPECT_GT(alone, 0u);
  EXPECT_EQ(alone_beside, 0u);
}

TEST(MostRays, AreFewAtFirstAndRaisedToAllThereAre) {
  RadiosityOptions options;
  options.samples = 4096, options.error = 0.02;
  MostRays most(options);
  EXPECT_EQ(most.of_both(), 1024u);
  EXPECT_TRUE(most.raise());
  EXPECT_TRUE(most.raise());
  EXPECT_EQ(most.of_both(), 4096u);
  EXPECT_FALSE(most.raise());
  options.error = 0;  // all samples are taken
  EXPECT_EQ(MostRays(options).of_both(), 4096u);
  options.error = 0.5, options.samples = 100;
  EXPECT_EQ(MostRays(options).of_both(), 100u);
  options.error = 1e-9, options.samples = 4000;
  EXPECT_EQ(MostRays(options).of_both(), 4000u);
}

}  // namespace
}  // namespace oriel
