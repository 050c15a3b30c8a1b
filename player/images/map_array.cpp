#include "player/images/map_array.h"

#include <algorithm>
#include <array>
#include <utility>

#include "formats/core/parallel.h"

namespace oriel {

namespace {

// Arrays without pixels.
MapArrayData shape_of(const IVec2& size, int layers) {
  Relief largest;
  largest.size = size;
  const IVec2 range_size = largest.range_size(1);
  const auto shape = [&](const gpu::TextureFormat& format, const IVec2& extent) {
    TextureData data;
    data.format = format;
    data.width = extent.x;
    data.height = extent.y;
    data.layers = layers;
    return data;
  };
  MapArrayData out{
      shape(gpu::kRgb9e5, size), shape(gpu::kR16, size), shape(gpu::kRg16, {range_size.x, range_size.y * 3 / 2}), {}};
  for (TextureData* filtered : {&out.disparity, &out.light})
    filtered->options.min_filter = filtered->options.mag_filter = GL_LINEAR;
  out.light.options.levels = gpu::mip_levels(size.x, size.y);
  out.light.options.min_filter = GL_LINEAR_MIPMAP_LINEAR;
  return out;
}

using RangeCode = std::array<std::uint16_t, 2>;

std::vector<RangeCode> coded(std::span<const Vec2> ranges) {
  std::vector<RangeCode> codes;
  codes.reserve(ranges.size());
  for (const Vec2& r : ranges)  // of nothing: the largest number, then the least
    codes.push_back({disparity_code(std::clamp(r.x, 0.0f, kUnseenDisparity)),
                     disparity_code(std::clamp(r.y, 0.0f, kUnseenDisparity))});
  return codes;
}

// Level 1, and above it the others beside each other: `width` and `height` are those of level 1 of the array.
void add_ranges(const Relief& relief, int layer, int width, int height, TextureData& ranges) {
  const IVec2 first = relief.range_size(1);
  ranges.add({0, layer, 0, first.x, first.y}, coded(relief.ranges[0]));
  std::vector<RangeCode> strip(static_cast<std::size_t>(width) * static_cast<std::size_t>(height / 2));
  for (int level = 2; level <= kRangeLevels; ++level) {
    const IVec2 cells = relief.range_size(level);
    const std::vector<RangeCode> codes = coded(relief.ranges[static_cast<std::size_t>(level - 1)]);
    for (int y = 0; y < cells.y; ++y)
      std::copy_n(codes.begin() + y * cells.x, cells.x, strip.begin() + y * width + width - (width >> (level - 2)));
  }
  ranges.add({0, layer, height, width, height / 2}, std::move(strip));
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

void add_relief(const Relief& relief, int layer, MapArrayData& out) {
  add_ranges(relief, layer, out.ranges.width, out.ranges.height * 2 / 3, out.ranges);
  std::vector<std::uint16_t> codes;
  codes.reserve(relief.disparity.size());
  for (const float s : relief.disparity) codes.push_back(disparity_code(s));
  out.disparity.add({0, layer, 0, relief.size.x, relief.size.y}, std::move(codes));
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
  std::vector<Relief> reliefs(maps.size());
  for_each_parallel(maps.size(), std::min(core_count(), kAtOnce),
                    [&](std::size_t layer) { reliefs[layer] = make_relief(*maps[layer]); });
  for (std::size_t layer = 0; layer < maps.size(); ++layer)
    add_relief(std::exchange(reliefs[layer], {}), static_cast<int>(layer), out);
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
  return shape.light.bytes() + shape.disparity.bytes() + shape.ranges.bytes();
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
