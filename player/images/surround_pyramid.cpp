#include "player/images/surround_pyramid.h"

#include <algorithm>
#include <bit>

#include "formats/core/half.h"
#include "formats/core/octahedral.h"

namespace oriel {
namespace {

// A square image, row by row.
template <class T>
struct Square {
  int size = 0;
  std::vector<T> texels;
  explicit Square(int side) : size(side), texels(static_cast<std::size_t>(side) * static_cast<std::size_t>(side)) {}
  T& at(int x, int y) { return texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(size) + std::size_t(x)]; }
  const T& at(int x, int y) const {
    return texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(size) + std::size_t(x)];
  }
};

// Light, and in w the usable part of the texel's solid angle, in those of a texel in the middle of the map.
using LightLevel = Square<Vec4>;

LightLevel first_level(const SurroundMap& map) {
  LightLevel level(static_cast<int>(map.size));
  for (std::size_t i = 0; i < level.texels.size(); ++i) {
    if (map.valid[i] == 0 || !is_finite(map.radiance[i])) continue;
    const Vec2 at = (Vec2(i % map.size, i / map.size) + 0.5f) / static_cast<float>(map.size) * 2.0f - 1.0f;
    level.texels[i] = Vec4(map.radiance[i], std::pow(glm::length(direction_from_octahedral(at)), -3.0f));
  }
  return level;
}

LightLevel halved(const LightLevel& fine) {
  LightLevel out(fine.size / 2);
  for (int y = 0; y < out.size; ++y)
    for (int x = 0; x < out.size; ++x) {
      Vec4 sum(0);
      for (int k = 0; k < 4; ++k) {
        const Vec4& light = fine.at(2 * x + (k & 1), 2 * y + (k >> 1));
        sum += light.w * Vec4(Vec3(light), 1);
      }
      out.at(x, y) = sum.w > 0 ? Vec4(Vec3(sum) / sum.w, 0.25f * sum.w) : Vec4(0);
    }
  return out;
}

// From coarse to fine: what has no light of its own takes that of the level above.
void fill_gaps(std::vector<LightLevel>& levels) {
  for (std::size_t l = levels.size() - 1; l-- > 0;)
    for (int y = 0; y < levels[l].size; ++y)
      for (int x = 0; x < levels[l].size; ++x)
        if (levels[l].at(x, y).w <= 0) levels[l].at(x, y) = levels[l + 1].at(x / 2, y / 2);
}

// Calls put(x, y, from) for each texel of a level with its border, the corner of the border at (0, 0).
template <class Put>
void each_with_border(int size, const Put& put) {
  for (int y = -1; y <= size; ++y)
    for (int x = -1; x <= size; ++x) put(x + 1, y + 1, wrap_octahedral({x, y}, size));
}

IVec2 pyramid_extent(int size, int last) {
  const IVec2 end = last > 0 ? pyramid_corner(size, last) + 3 : IVec2(3);
  return {std::max(size + 2, last > 0 ? size + size / 2 + 4 : 0), std::max(size + 2, end.y)};
}

}  // namespace

IVec2 pyramid_corner(int size, int level) {
  return level == 0 ? IVec2(0) : IVec2(size + 2, size - (size >> (level - 1)) + 2 * (level - 1));
}

SurroundPyramid make_surround_pyramid(const SurroundMap& map) {
  SurroundPyramid out;
  out.size = static_cast<int>(map.size);
  std::vector<LightLevel> levels{first_level(map)};
  while (levels.back().size > 1) levels.push_back(halved(levels.back()));
  fill_gaps(levels);
  float brightest = 0;
  for (const Vec4& light : levels[0].texels) brightest = std::max(brightest, max_component(Vec3(light)));
  if (brightest > 0) out.scale = std::ldexp(1.0f, std::clamp(std::ilogb(brightest) - 14, -120, 120));

  const int last = static_cast<int>(levels.size()) - 1;
  out.extent = pyramid_extent(out.size, last);
  out.light.resize(static_cast<std::size_t>(out.extent.x) * static_cast<std::size_t>(out.extent.y));
  for (int l = 0; l <= last; ++l) {
    const LightLevel& level = levels[static_cast<std::size_t>(l)];
    const IVec2 corner = pyramid_corner(out.size, l);
    each_with_border(level.size, [&](int x, int y, const IVec2& from) {
      const auto at = static_cast<std::size_t>((corner.y + y) * out.extent.x + corner.x + x);
      out.light[at] = rgb9e5_from_rgb(Vec3(level.at(from.x, from.y)) / out.scale);
    });
  }

  Square<float> distances(out.size), bordered(out.size + 2);
  distances.texels = map.inverse_distance;
  each_with_border(out.size,
                   [&](int x, int y, const IVec2& from) { bordered.at(x, y) = distances.at(from.x, from.y); });
  out.inverse_distance = std::move(bordered.texels);
  const auto [least, most] = std::minmax_element(map.inverse_distance.begin(), map.inverse_distance.end());
  out.range = {*most, *least};
  return out;
}

namespace {

// Without pixels.
SurroundData shape_of(int size, const IVec2& extent) {
  SurroundData out;
  out.light.format = gpu::kRgb9e5;
  out.light.width = extent.x;
  out.light.height = extent.y;
  out.inverse_distance.format = gpu::kR32f;
  out.inverse_distance.width = out.inverse_distance.height = size + 2;
  for (TextureData* data : {&out.light, &out.inverse_distance})
    data->options.min_filter = data->options.mag_filter = GL_LINEAR;
  return out;
}

}  // namespace

SurroundData surround_data(const SurroundMap& map) {
  SurroundPyramid pyramid = make_surround_pyramid(map);
  SurroundData out = shape_of(pyramid.size, pyramid.extent);
  out.light.add({0, 0, 0, pyramid.extent.x, pyramid.extent.y}, std::move(pyramid.light));
  out.inverse_distance.add({0, 0, 0, pyramid.size + 2, pyramid.size + 2}, std::move(pyramid.inverse_distance));
  out.place.size = pyramid.size;
  out.place.scale = pyramid.scale;
  out.place.range = pyramid.range;
  return out;
}

std::size_t surround_bytes(std::uint32_t size) {
  const int side = static_cast<int>(size);
  const SurroundData shape = shape_of(side, pyramid_extent(side, std::bit_width(size) - 1));
  return shape.light.bytes() + shape.inverse_distance.bytes();
}

}  // namespace oriel
