#include "bake/radiosity/shadow_lists.h"

#include <algorithm>
#include <functional>
#include <map>

#include "bake/jobs/parallel.h"
#include "bake/radiosity/tile_lister.h"

namespace oriel {
namespace {

constexpr std::size_t kTilesAtOnce = 128;  // in memory

struct TileOfChart {
  std::uint32_t chart = 0;
  UVec2 lower{0};
};

// Those of large charts first.
std::vector<TileOfChart> tiles_of(const SharpCharts& sharp) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t c = 0; c < sharp.charts.size(); ++c)
    if (sharp.charts[c].flat) order.push_back(c);
  std::ranges::stable_sort(order, std::greater(), [&](std::uint32_t c) {
    const UVec2 size = sharp.charts[c].upper - sharp.charts[c].lower;
    return std::uint64_t{size.x} * size.y;
  });
  std::vector<TileOfChart> tiles;
  for (const std::uint32_t c : order)
    for (std::uint32_t y = sharp.charts[c].lower.y; y < sharp.charts[c].upper.y; y += kTile)
      for (std::uint32_t x = sharp.charts[c].lower.x; x < sharp.charts[c].upper.x; x += kTile)
        tiles.push_back({c, {x, y}});
  return tiles;
}

// The lists of some tiles, and what they come to.
void write_tile(const ListedScene& in, const TileOfChart& tile, const TileRecords& records, SharpWriter& writer,
                ShadowLists& out) {
  const std::uint32_t page = in.sharp.charts[tile.chart].page;
  const UVec2 size(in.scene.map[page].width, in.scene.map[page].height);
  std::map<const SharpRecord*, std::uint32_t> places;
  for (std::uint32_t k = 0; k < records.size(); ++k) {
    const UVec2 at = tile.lower + UVec2(k % kTile, k / kTile);
    if (!records[k] || at.x >= size.x || at.y >= size.y) continue;
    const std::size_t texel = std::size_t{at.y} * size.x + at.x;
    if (in.charts[page][texel] != tile.chart) continue;
    const auto [place, anew] = places.try_emplace(records[k].get(), 0);
    if (anew) place->second = writer.place_of(*records[k]);
    if (out.at[page].empty()) out.at[page].resize(in.charts[page].size());
    out.at[page][texel] = place->second;
  }
}

// What of a chart is listed is not shown without the rest.
void leave_out_charts(const ListedScene& in, std::span<const TileOfChart> tiles, ShadowLists& out) {
  std::vector<bool> left(in.sharp.charts.size());
  for (const TileOfChart& tile : tiles) left[tile.chart] = true;
  for (std::uint32_t c = 0; c < left.size(); ++c)
    if (left[c]) out.left_out.push_back(c);
  for (std::size_t p = 0; p < out.at.size(); ++p)
    for (std::size_t i = 0; i < out.at[p].size(); ++i)
      if (in.charts[p][i] != ~0u && left[in.charts[p][i]]) out.at[p][i] = 0;
}

}  // namespace

Result<ShadowLists> list_shadows(const LightmapScene& scene, const SharpCharts& sharp,
                                 const std::function<bool()>& enough, const Stage& stage) {
  const ShadowCasters casters(scene.transport.accel.scene(), sharp.lights);
  const ListedScene in{scene, sharp, casters, charts_of_texels(scene.atlas, scene.map)};
  const std::vector<TileOfChart> tiles = tiles_of(sharp);
  ShadowLists out;
  out.at.resize(scene.map.size());
  add_lamps(scene.transport.accel.scene(), sharp.lights, out.light);
  SharpWriter writer(casters, out.light);
  for (std::size_t first = 0; first < tiles.size(); first += kTilesAtOnce) {
    if ((enough && enough()) || out.light.words.size() > kMostSharpWords / 2 ||
        out.light.triangles.size() > kMostSharpTriangles / 2) {
      leave_out_charts(in, std::span(tiles).subspan(first), out);
      break;
    }
    std::vector<TileRecords> listed(std::min(kTilesAtOnce, tiles.size() - first));
    ORIEL_TRY_VOID(parallel_for(stage, "sharp light", listed.size(), [&](std::size_t i) {
      TileLister lister(in, tiles[first + i].chart);
      listed[i] = lister.list(tiles[first + i].lower);
      stage.count(lister.rays());
    }));
    for (std::size_t i = 0; i < listed.size(); ++i) write_tile(in, tiles[first + i], listed[i], writer, out);
  }
  return out;
}

}  // namespace oriel
