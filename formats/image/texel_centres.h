// Which texels of a lightmap a triangle shows.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "formats/core/vec.h"

namespace oriel {

// Calls visit(x, y, barycentric) for every texel of a page whose centre lies in the triangle; one on an edge belongs to
// both sides. uv: lightmap coordinates of its corners.
template <class Visit>
void for_texel_centres(const std::array<Vec2, 3>& uv, std::uint32_t width, std::uint32_t height, Visit&& visit) {
  constexpr float kInside = -1e-4f;  // least barycentric coordinate
  std::array<DVec2, 3> p;
  for (std::size_t c = 0; c < 3; ++c) p[c] = DVec2(uv[c]) * DVec2(width, height) - 0.5;
  const auto cross = [](const DVec2& a, const DVec2& b) { return a.x * b.y - a.y * b.x; };
  const double area = cross(p[1] - p[0], p[2] - p[0]);
  if (area == 0) return;
  const auto range = [](double a, double b, double c, std::uint32_t size) {
    const double low = std::max(std::ceil(std::min({a, b, c})), 0.0);
    return std::pair(static_cast<std::uint32_t>(low),
                     static_cast<std::uint32_t>(std::clamp(std::floor(std::max({a, b, c})) + 1, 0.0, double(size))));
  };
  const auto [x0, x1] = range(p[0].x, p[1].x, p[2].x, width);
  const auto [y0, y1] = range(p[0].y, p[1].y, p[2].y, height);
  for (std::uint32_t y = y0; y < y1; ++y)
    for (std::uint32_t x = x0; x < x1; ++x) {
      const DVec2 at(x, y);
      const Vec3 b(cross(p[1] - at, p[2] - at) / area, cross(p[2] - at, p[0] - at) / area,
                   cross(p[0] - at, p[1] - at) / area);
      if (std::min({b.x, b.y, b.z}) >= kInside && std::max({b.x, b.y, b.z}) <= 1 - kInside) visit(x, y, b);
    }
}

}  // namespace oriel
