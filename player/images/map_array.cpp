#include "player/images/map_array.h"

#include <algorithm>
#include <array>
#include <utility>

#include "formats/core/parallel.h"

namespace oriel {

namespace {

// Arrays without pixels.
MapArrayData shape_of(const IVec2& size, int layers) {
  const auto shape = [&](const gpu::TextureFormat& format) {
    TextureData data;
    data.format = format;
    data.width = size.x;
    data.height = size.y;
    data.layers = layers;
    return data;
  };
  MapArrayData out{shape(gpu::kRgb9e5), shape(gpu::kR16), {}};
  for (TextureData* filtered : {&out.disparity, &out.light})
    filtered->options.min_filter = filtered->options.mag_filter = GL_LINEAR;
  out.light.options.levels = gpu::mip_levels(size.x, size.y);
  out.light.options.min_filter = GL_LINEAR_MIPMAP_LINEAR;
  return out;
}

MapArrayData shape_of(std::span<const IVec2> sizes) {
  IVec2 size(1);
  for (const IVec2& of_map : sizes) size = glm::max(size, of_map);
  return shape_of(size, static_cast<int>(sizes.size()));
}

std::vector<IVec2> sizes_of(std::span<const RadianceMap* const> maps) {
  std::vector<IVec2> sizes;
  for (const RadianceMap* map : maps) sizes.emplace_back(static_cast<int>(map->width), static_cast<int>(map->height));
  return sizes;
}

void add_light(LightLevels levels, int layer, const IVec2& of_map, MapArrayData& out) {
  const IVec2 size(out.light.width, out.light.height);
  for (int level = 0; of_map != size && level < out.light.options.levels;
       ++level) {  // filters may touch what is beside it
    const int w = std::max(size.x >> level, 1), h = std::max(size.y >> level, 1);
    out.light.add({level, layer, 0, w, h},
                  std::vector<std::uint32_t>(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)));
  }
  for (std::size_t level = 0; level < levels.rgb9e5.size(); ++level)
    out.light.add({static_cast<int>(level), layer, 0, std::max(of_map.x >> level, 1), std::max(of_map.y >> level, 1)},
                  std::move(levels.rgb9e5[level]));
  out.scale.push_back(levels.scale);
}

constexpr std::size_t kAtOnce = 4;  // a map takes a few hundred bytes a pixel meanwhile

}  // namespace

MapArrayData MapArrayData::make(std::span<const RadianceMap* const> maps) {
  MapArrayData out = light_of(maps);
  for (std::size_t layer = 0; layer < maps.size(); ++layer) {
    const int width = static_cast<int>(maps[layer]->width), height = static_cast<int>(maps[layer]->height);
    out.disparity.add({0, static_cast<int>(layer), 0, width, height}, disparity_codes(*maps[layer]));
  }
  return out;
}

MapArrayData MapArrayData::light_of(std::span<const RadianceMap* const> maps) {
  const std::vector<IVec2> sizes = sizes_of(maps);
  MapArrayData out = shape_of(sizes);
  std::vector<LightLevels> levels(maps.size());
  for_each_parallel(maps.size(), std::min(core_count(), kAtOnce),
                    [&](std::size_t layer) { levels[layer] = make_light_levels(*maps[layer]); });
  for (std::size_t layer = 0; layer < maps.size(); ++layer)
    add_light(std::move(levels[layer]), static_cast<int>(layer), sizes[layer], out);
  return out;
}

std::size_t map_array_bytes(std::span<const IVec2> sizes) {
  const MapArrayData shape = shape_of(sizes);
  return shape.light.bytes() + shape.disparity.bytes();
}

std::size_t map_light_bytes(std::span<const IVec2> sizes) {
  return shape_of(sizes).light.bytes();
}

RadianceMap coarser_map(const RadianceMap& map, int coarser) {
  RadianceMap out = map;
  if (coarser < 1) return out;
  out.width = std::max(map.width >> coarser, 1u);
  out.height = std::max(map.height >> coarser, 1u);
  out.radiance.clear();
  out.disparity.clear();
  out.valid.clear();
  for (std::uint32_t y = 0; y < out.height; ++y)
    for (std::uint32_t x = 0; x < out.width; ++x) {
      // The pixel in the square's middle.
      const std::size_t at = std::size_t{(2 * y + 1) * map.height / (2 * out.height)} * map.width +
                             (2 * x + 1) * map.width / (2 * out.width);
      out.radiance.push_back(map.radiance[at]);
      out.disparity.push_back(map.disparity[at]);
      out.valid.push_back(map.valid[at]);
    }
  return out;
}

}  // namespace oriel
