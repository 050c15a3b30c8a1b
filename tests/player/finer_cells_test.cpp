// Finer cells of the lightmap, in frames from near and far.
#include "tests/player/frame_fixture.h"

namespace oriel {
namespace {

using namespace testing;

constexpr std::uint32_t kTexels = 8;
constexpr float kEdge = 3.1f;  // from the centre of the first texel: a shadow's edge

// A wall of 2 m. Texels know to which side of the edge their centres lie, cells know it to a step.
Pack wall_with_an_edge(std::uint32_t log2_side) {
  Pack pack;
  pack.materials.resize(1);
  pack.materials[0].base_color = Vec3(0.5f);
  add_quad(pack, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 0, 0);
  const auto light = [](float x) { return Vec3(x < kEdge ? 1000.0f : 0.0f); };
  LightmapPage page = page_of(kTexels, [&](std::uint32_t x, auto) { return light(static_cast<float>(x)); });
  const std::uint32_t side = 1u << log2_side, row = kTexels * (side + 1);
  page.detail_width = page.detail_height = row;
  page.cell.assign(kTexels * kTexels, 0), page.detail.resize(std::size_t{row} * row);
  for (std::uint32_t y = 0; y + 1 < kTexels; ++y)
    for (std::uint32_t x = 0; x + 1 < kTexels; ++x) {
      const DetailBlock block{x * (side + 1), y * (side + 1), log2_side};
      page.cell[y * kTexels + x] = block.code();
      for (std::uint32_t j = 0; j <= side; ++j)
        for (std::uint32_t i = 0; i <= side; ++i)
          page.detail[std::size_t{block.y + j} * row + block.x + i] =
              light(static_cast<float>(x) + static_cast<float>(i) / static_cast<float>(side));
    }
  pack.lightmaps = {page};
  return pack;
}

using FinerCells = FrameTest;

void expect_a_sharp_edge(const Picture& picture) {
  const float pixel_m = 2 * 2 * std::tan(0.5f) / 24;
  const float texel_m = 2.0f / static_cast<float>(kTexels);
  const float lit = 1000 * 0.5f / kPi;
  double sum = 0, wanted = 0;
  for (int x = 6; x < 26; ++x) {
    const float at_m = (static_cast<float>(x) + 0.5f - 16) * pixel_m, edge_m = (kEdge + 0.5f) * texel_m - 1;
    const float share = std::clamp((edge_m - at_m) / pixel_m + 0.5f, 0.0f, 1.0f);
    sum += double{picture.at(x, 12).g}, wanted += double{lit * share};
    if (std::fabs(at_m - edge_m) < pixel_m) continue;
    EXPECT_NEAR(picture.at(x, 12).g, lit * share, 0.01f * lit) << x;
  }
  EXPECT_NEAR(sum, wanted, 0.25 * double{lit}) << "a quarter of a pixel: four places share it";
}

// A pixel of 9 cm is three steps wide, or eleven, and a third of a texel.
TEST_F(FinerCells, KeepEdgesSharpWherePixelsAreWiderThanTheirSteps) {
  const Camera camera{"c", {0, 0, 2}, {0, 0, -1}, {0, 1, 0}, 1.0f, 0};
  for (const std::uint32_t log2_side : {3u, 5u}) {
    SCOPED_TRACE(log2_side);
    expect_a_sharp_edge(draw(wall_with_an_edge(log2_side), camera, 32, 24));
  }
}

// Where a texel is smaller than a pixel the cells are gone, and with them what would flicker.
TEST_F(FinerCells, FadeToTexelsFarAway) {
  const Camera camera{"c", {0, 0, 20}, {0, 0, -1}, {0, 1, 0}, 1.0f, 0};
  const Pack pack = wall_with_an_edge(5);
  Pack plain = pack;
  plain.lightmaps[0].cell.clear(), plain.lightmaps[0].detail.clear();
  plain.lightmaps[0].detail_width = plain.lightmaps[0].detail_height = 0;
  EXPECT_EQ(draw(pack, camera, 32, 24).rgb, draw(plain, camera, 32, 24).rgb);
}

}  // namespace
}  // namespace oriel
