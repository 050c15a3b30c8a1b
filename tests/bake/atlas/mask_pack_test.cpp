#include "bake/atlas/mask_pack.h"

#include <gtest/gtest.h>

#include <cmath>

namespace oriel {
namespace {

TexelMask full(std::uint32_t width, std::uint32_t height) {
  TexelMask mask(width, height);
  for (std::uint32_t y = 0; y < height; ++y) mask.set_span(0, width - 1, y);
  return mask;
}

TexelMask lower_triangle(std::uint32_t side) {
  TexelMask mask(side, side);
  for (std::uint32_t y = 0; y < side; ++y) mask.set_span(0, side - 1 - y, y);
  return mask;
}

// Which mask lies on each texel of a page; fails where two do, or one reaches over the border.
std::vector<int> paint(const std::vector<TexelMask>& masks, const std::vector<PackedChart>& charts, std::uint32_t index,
                       const PackedPage& page) {
  std::vector<int> owner(std::size_t{page.width} * page.height, -1);
  for (std::size_t i = 0; i < masks.size(); ++i) {
    if (charts[i].page != index) continue;
    TexelMask mask = masks[i];
    for (std::uint32_t turn = 0; turn < charts[i].turns; ++turn) mask = mask.turned();
    for (std::uint32_t y = 0; y < mask.height(); ++y)
      for (std::uint32_t x = 0; x < mask.width(); ++x) {
        if (!mask.at(x, y)) continue;
        EXPECT_LT(charts[i].x + x, page.width);
        EXPECT_LT(charts[i].y + y, page.height);
        int& at = owner[(charts[i].y + y) * page.width + charts[i].x + x];
        EXPECT_EQ(at, -1);
        at = static_cast<int>(i);
      }
  }
  return owner;
}

// Texels that lie nearer than `padding` to one of another mask.
int crowded(const std::vector<int>& owner, const PackedPage& page, int padding) {
  int count = 0;
  const int width = static_cast<int>(page.width), height = static_cast<int>(page.height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int v = std::max(0, y - padding); v <= std::min(height - 1, y + padding); ++v)
        for (int u = std::max(0, x - padding); u <= std::min(width - 1, x + padding); ++u) {
          const int a = owner[static_cast<std::size_t>(y * width + x)],
                    b = owner[static_cast<std::size_t>(v * width + u)];
          count += a >= 0 && b >= 0 && a != b;
        }
  return count;
}

TEST(TexelMask, TurnsAndCounts) {
  TexelMask mask(70, 3);
  mask.set_span(63, 65, 1);
  mask.set(0, 0);
  EXPECT_EQ(mask.count(), 4u);
  const TexelMask turned = mask.turned();
  EXPECT_EQ(turned.width(), 3u);
  EXPECT_EQ(turned.height(), 70u);
  EXPECT_TRUE(turned.at(2, 0) && turned.at(1, 63) && turned.at(1, 64) && turned.at(1, 65));
  EXPECT_EQ(turned.count(), 4u);
}

TEST(MaskPack, NothingOverlapsAndPaddingHolds) {
  std::vector<TexelMask> masks;
  std::uint32_t state = 99;
  const auto random = [&](std::uint32_t n) {
    return (state = state * 1664525u + 1013904223u) % 65536u * n / 65536u + 1;
  };
  for (int i = 0; i < 300; ++i) {
    TexelMask mask(random(90), random(25));
    for (std::uint32_t y = 0; y < mask.height(); ++y) {
      const std::uint32_t first = random(mask.width()) - 1;
      mask.set_span(first, first + random(mask.width() - first) - 1, y);
    }
    masks.push_back(mask);
  }
  for (const bool compact : {false, true}) {
    std::vector<PackedChart> charts(masks.size());
    const PackLimits limits{128, 100, 2, 1000};
    const auto pages = compact ? pack_compact(masks, limits, charts) : pack_masks(masks, limits, charts);
    ASSERT_GT(pages.size(), 1u);
    for (std::uint32_t p = 0; p < pages.size(); ++p) {
      ASSERT_TRUE(pages[p].width <= 128 && pages[p].height <= 100);
      const std::vector<int> owner = paint(masks, charts, p, pages[p]);
      EXPECT_EQ(crowded(owner, pages[p], 2), 0);
      EXPECT_GT(crowded(owner, pages[p], 4), 0);  // the checker can fail
    }
  }
}

TEST(MaskPack, FillsAPageExactly) {
  std::vector<TexelMask> masks(16, full(4, 4));
  std::vector<PackedChart> charts(17);
  EXPECT_EQ(pack_masks(masks, {16, 16, 0, 1}, std::span(charts).first(16)).size(), 1u);
  masks.push_back(full(1, 1));
  EXPECT_TRUE(pack_masks(masks, {16, 16, 0, 1}, charts).empty());
  EXPECT_EQ(pack_masks(masks, {16, 16, 0, 2}, charts).size(), 2u);
  const std::vector<TexelMask> large{full(17, 1)};
  EXPECT_TRUE(pack_masks(large, {16, 16, 0, 10}, std::span(charts).first(1)).empty());
}

TEST(MaskPack, TurnsWhatFitsOnlySo) {
  const std::vector<TexelMask> masks{full(20, 3), full(20, 3), full(20, 3), full(20, 3), full(20, 3)};
  std::vector<PackedChart> charts(masks.size());
  ASSERT_EQ(pack_masks(masks, {15, 20, 0, 1}, charts).size(), 1u);
  for (const PackedChart& chart : charts) EXPECT_EQ(chart.turns % 2, 1u);
}

TEST(MaskPack, TrianglesShareTheirBoxes) {
  const std::vector<TexelMask> masks(2, lower_triangle(16));  // 136 of 256 texels each
  std::vector<PackedChart> charts(2);
  const auto pages = pack_masks(masks, {17, 17, 0, 1}, charts);
  ASSERT_EQ(pages.size(), 1u);
  paint(masks, charts, 0, pages[0]);
}

TEST(MaskPack, SmallOnesGoIntoHoles) {
  TexelMask ring(30, 30);
  for (std::uint32_t y = 0; y < 30; ++y) {
    ring.set_span(0, 2, y);
    ring.set_span(27, 29, y);
    if (y < 3 || y > 26) ring.set_span(0, 29, y);
  }
  const std::vector<TexelMask> masks{ring, full(20, 20)};
  std::vector<PackedChart> charts(2);
  ASSERT_EQ(pack_masks(masks, {30, 30, 2, 1}, charts).size(), 1u);
  EXPECT_EQ(crowded(paint(masks, charts, 0, {30, 30}), {30, 30}, 2), 0);
}

TEST(MaskPack, CompactIsAboutSquare) {
  const std::vector<TexelMask> masks(100, full(10, 10));
  std::vector<PackedChart> charts(100);
  const auto pages = pack_compact(masks, {2048, 2048, 2, 1}, charts);
  ASSERT_EQ(pages.size(), 1u);
  EXPECT_LT(pages[0].width, 140u);
  EXPECT_LT(pages[0].height, 140u);
}

}  // namespace
}  // namespace oriel
