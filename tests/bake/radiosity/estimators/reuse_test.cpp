// Which tiles of texels keep their light after an edit, and how far off that is.
#include "bake/radiosity/estimators/reuse.h"

#include <gtest/gtest.h>

#include <numeric>

namespace oriel {
namespace {

constexpr std::uint32_t kReusedSide = 8, kTiles = 4;

// Tiles of 8 by 8 texels beside each other on one page, all visible.
struct Page {
  Texels texels;
  std::vector<std::uint32_t> order;
  PreviousLight previous;

  explicit Page(float light) {
    const std::uint32_t n = kTiles * kReusedSide * kReusedSide;
    texels.pages.push_back({kTiles * kReusedSide, kReusedSide, std::vector<std::uint32_t>(n), {}, 0});
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t x = i / (kReusedSide * kReusedSide) * kReusedSide + i % kReusedSide,
                          y = i / kReusedSide % kReusedSide;
      texels.pages[0].number[y * kTiles * kReusedSide + x] = i;
      texels.page.push_back(0), texels.x.push_back(x), texels.y.push_back(y), texels.chart.push_back(0);
    }
    texels.visible.assign(n, 1);
    texels.covered.assign(n, 1);
    order.resize(n);
    std::iota(order.begin(), order.end(), 0u);
    previous.page = texels.page, previous.x = texels.x, previous.y = texels.y, previous.chart = texels.chart;
    previous.coarse.assign(n, Vec3(light));
    previous.first_pass.assign(n, Vec3(light));
  }

  // Tile t is changed by step * t.
  std::vector<Vec3> changed(float step) const {
    std::vector<Vec3> light(previous.coarse);
    for (std::size_t i = 0; i < light.size(); ++i)
      light[i] += step * static_cast<float>(i / (kReusedSide * kReusedSide));
    return light;
  }
};

TEST(Reuse, TilesKeepLightThatChangesByLessThanIsAllowed) {
  const Page page(100);
  Reuse reuse(page.texels, page.texels.chart, page.previous);
  reuse.compare(page.texels, page.order, page.changed(1.5f), false, 0.02);
  EXPECT_EQ(reuse.report().tiles, kTiles);
  EXPECT_EQ(reuse.report().reused, 2u) << "0 and 1.5 %, not 3 and 4.5 %";
  EXPECT_TRUE(reuse.reuses(0) && reuse.reuses(64) && !reuse.reuses(128) && !reuse.reuses(192));
  EXPECT_NEAR(reuse.report().error, 0.5 * 1.5 / 101.5, 1e-5) << "one tile of four is off";
  EXPECT_NEAR(reuse.change(64), 1.5 / 101.5, 1e-5);
  EXPECT_EQ(reuse.change(0), 0);
}

TEST(Reuse, ALocalChangeCountsByItsRootMeanSquare) {
  const Page page(100);
  std::vector<Vec3> now(page.previous.coarse);
  now[5] = Vec3(50);  // relative to what is there now: 1, of 64 texels: 1/8
  Reuse reuse(page.texels, page.texels.chart, page.previous);
  reuse.compare(page.texels, page.order, now, false, 0.1249);
  EXPECT_FALSE(reuse.reuses(0));
  reuse = Reuse(page.texels, page.texels.chart, page.previous);
  reuse.compare(page.texels, page.order, now, false, 0.1251);
  EXPECT_TRUE(reuse.reuses(0));
}

TEST(Reuse, OtherChartsAndTexelsThatWereNotThereAreBaked) {
  Page page(100);
  page.previous.chart[70] = 1;
  page.previous.page[130] = 7;
  Reuse reuse(page.texels, page.texels.chart, page.previous);
  reuse.compare(page.texels, page.order, page.previous.coarse, false, 1);
  EXPECT_EQ(reuse.report().reused, 2u);
  EXPECT_EQ(reuse.before(70), kNoTexel);
  EXPECT_EQ(reuse.before(71), 71u);
}

TEST(Reuse, ADarkSceneThatStaysDarkIsKeptAndOneThatIsLitIsNot) {
  const Page page(0);
  Reuse reuse(page.texels, page.texels.chart, page.previous);
  reuse.compare(page.texels, page.order, page.previous.coarse, false, 0.02);
  EXPECT_EQ(reuse.report().reused, kTiles);
  EXPECT_EQ(reuse.report().error, 0);
  reuse = Reuse(page.texels, page.texels.chart, page.previous);
  reuse.compare(page.texels, page.order, std::vector<Vec3>(page.order.size(), Vec3(1)), false, 0.02);
  EXPECT_EQ(reuse.report().reused, 0u);
}

TEST(Reuse, DirectLightIsTheSameWhereItAndItsNeighboursLookTheSame) {
  const Page page(100);
  const Reuse reuse(page.texels, page.texels.chart, page.previous);
  TexelGraph graph;
  graph.neighbour.resize(page.order.size());
  graph.count.assign(page.order.size(), 0);
  graph.neighbour[3][0] = 4, graph.count[3] = 1;
  graph.neighbour[4][0] = 3, graph.count[4] = 1;
  std::vector<Vec3> first_pass(page.previous.first_pass);
  first_pass[4].b = 99;
  const std::vector<bool> same = reuse.same_first_pass(graph, first_pass);
  EXPECT_TRUE(same[2] && !same[3] && !same[4] && same[5]);
}

TEST(Reuse, NothingIsRecalledFromAStoreWithout) {
  Context context;
  EXPECT_FALSE(load_previous_light(context, Hash128(), false));
}

}  // namespace
}  // namespace oriel
