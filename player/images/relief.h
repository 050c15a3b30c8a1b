// A radiance map prepared for marching: its disparities as a height field with ranges, and its light at several sizes.
#pragma once

#include <array>
#include <vector>

#include "formats/assets/radiance_map.h"

namespace oriel {

// Stands for pixels that saw nothing usable: nearer than any ray, so that rays pass behind them.
inline constexpr float kUnseenDisparity = 2;
// Disparities are multiples of 1 / kDisparityCodes, which the device has in 16 bits: off by no more than a 64th of a
// pixel of 1024, seen from as far away as the element is wide.
inline constexpr float kDisparityCodes = 32767;
inline std::uint16_t disparity_code(float s) {
  return static_cast<std::uint16_t>(s * kDisparityCodes + 0.5f);
}
// Ranges are kept for squares of 2 to 2^kRangeLevels pixels.
inline constexpr int kRangeLevels = 6;

struct Relief {
  IVec2 size{0};
  std::vector<float> disparity;  // row by row; [0, 1], or kUnseenDisparity
  // Entry (i, j) of level l, 1 … kRangeLevels: least and largest disparity over the square of 2^l pixels at (i, j) and
  // half as many around it. A step of at most 2^l pixels in x and y lies within the entry of its middle.
  std::array<std::vector<Vec2>, kRangeLevels> ranges;

  // The size of level 1 is a multiple of 2^(kRangeLevels-1), so that all levels halve evenly.
  IVec2 range_size(int level) const {
    return (((size + 1) / 2 + (1 << (kRangeLevels - 1)) - 1) >> (kRangeLevels - 1)) << (kRangeLevels - level);
  }
  float at(const IVec2& texel) const {
    return disparity[static_cast<std::size_t>(texel.y) * static_cast<std::size_t>(size.x) +
                     static_cast<std::size_t>(texel.x)];
  }
  const Vec2& range(int level, const IVec2& cell) const {
    return ranges[static_cast<std::size_t>(level - 1)]
                 [static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(range_size(level).x) +
                  static_cast<std::size_t>(cell.x)];
  }
};
Relief make_relief(const RadianceMap& map);

// Radiance over `scale`, a power of two that keeps it within RGB9E5, with averages over 2^i pixels at level i; sizes
// halve, rounded down, to 1. At each level what is unseen takes the mean of what is seen beside it, so that filtering
// brings in no black.
struct LightLevels {
  float scale = 1;
  std::vector<std::vector<std::uint32_t>> rgb9e5;
};
LightLevels make_light_levels(const RadianceMap& map);

}  // namespace oriel
