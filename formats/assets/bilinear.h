// Bilinear lookups in maps of texels.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "formats/assets/material.h"
#include "formats/core/vec.h"

namespace oriel {

struct TexelsAround {
  std::array<std::size_t, 4> texel{};  // y * width + x
  std::array<float, 4> weight{};       // sum 1
};

// Two texels along one axis and the share of the second.
struct TexelsAlong {
  std::size_t first = 0, second = 0;
  float share = 0;
};

// at: in widths of the map, 0 where it is not finite; size >= 1.
inline TexelsAlong texels_along(float at, std::uint32_t size, Wrap wrap) {
  if (!std::isfinite(at)) at = 0;
  const double period = wrap == Wrap::kMirror ? 2 : 1, n = size;
  const double within = wrap == Wrap::kClamp ? std::clamp(double{at}, 0.0, 1.0) : at - period * std::floor(at / period);
  const double texel = within * n - 0.5, low = std::floor(texel);
  const auto wrapped = [&](double i) {
    if (wrap == Wrap::kRepeat) i = i < 0 ? i + n : i >= n ? i - n : i;
    if (wrap == Wrap::kMirror && i >= n) i = 2 * n - 1 - i;
    return static_cast<std::size_t>(std::clamp(i, 0.0, n - 1));
  };
  return {wrapped(low), wrapped(low + 1), static_cast<float>(texel - low)};
}

inline TexelsAround texels_around(const Vec2& uv, std::uint32_t width, std::uint32_t height, Wrap wrap_s = Wrap::kClamp,
                                  Wrap wrap_t = Wrap::kClamp) {
  const TexelsAlong x = texels_along(uv.x, width, wrap_s), y = texels_along(uv.y, height, wrap_t);
  return {
      {y.first * width + x.first, y.first * width + x.second, y.second * width + x.first, y.second * width + x.second},
      {(1 - x.share) * (1 - y.share), x.share * (1 - y.share), (1 - x.share) * y.share, x.share * y.share}};
}

}  // namespace oriel
