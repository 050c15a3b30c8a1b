#include "player/maps/map_array.h"

#include <algorithm>

#include "formats/core/threads/parallel.h"

namespace oriel {

MapArray MapArray::upload(std::span<const RadianceMap> maps, std::span<const std::uint32_t> indices) {
  Relief largest;
  for (const std::uint32_t index : indices) {
    const RadianceMap& map = maps[index];
    largest.size = glm::max(largest.size, IVec2(static_cast<int>(map.width), static_cast<int>(map.height)));
  }
  const IVec2 size = largest.size, range_size = largest.range_size(1);
  const int layers = static_cast<int>(indices.size());
  MapArray out;
  gpu::TextureOptions filtered;
  filtered.min_filter = filtered.mag_filter = GL_LINEAR;
  out.disparity = gpu::TextureArray(gpu::kR32f, size.x, size.y, layers, filtered);
  filtered.levels = gpu::mip_levels(size.x, size.y);
  filtered.min_filter = GL_LINEAR_MIPMAP_LINEAR;
  out.light = gpu::TextureArray(gpu::kRgb9e5, size.x, size.y, layers, filtered);
  out.ranges = gpu::TextureArray(gpu::kRg32f, range_size.x, 2 * range_size.y, layers);
  struct Layer {
    Relief relief;
    LightLevels levels;
  };
  std::vector<Layer> made(indices.size());
  // A map takes a few hundred bytes a pixel meanwhile: not too many at once.
  for_each_parallel(made.size(), std::min<std::size_t>(core_count(), 4), [&](std::size_t layer) {
    const RadianceMap& map = maps[indices[layer]];
    made[layer] = {make_relief(map), make_light_levels(map)};
  });
  const std::vector<std::uint32_t> black(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
  for (int layer = 0; layer < layers; ++layer) {
    const auto [relief, levels] = std::move(made[static_cast<std::size_t>(layer)]);  // freed when uploaded
    out.disparity.upload(0, layer, 0, relief.size.x, relief.size.y, relief.disparity.data());
    for (int level = 1; level <= kRangeLevels; ++level) {
      const IVec2 cells = relief.range_size(level);
      const int row = 2 * range_size.y - (4 * range_size.y >> level);
      out.ranges.upload(0, layer, row, cells.x, cells.y, relief.ranges[static_cast<std::size_t>(level - 1)].data());
    }
    for (int level = 0; relief.size != size && level < filtered.levels;
         ++level) {  // filters may touch what is beside it
      out.light.upload(level, layer, 0, std::max(size.x >> level, 1), std::max(size.y >> level, 1), black.data());
    }
    for (std::size_t level = 0; level < levels.rgb9e5.size(); ++level) {
      const int w = std::max(relief.size.x >> level, 1), h = std::max(relief.size.y >> level, 1);
      out.light.upload(static_cast<int>(level), layer, 0, w, h, levels.rgb9e5[level].data());
    }
    out.scale.push_back(levels.scale);
  }
  return out;
}

}  // namespace oriel
