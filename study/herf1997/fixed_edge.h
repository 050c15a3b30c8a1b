// Projected edges in fixed point, so that every way to count shadows draws the same texels.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace oriel::study {

// The rows whose centres an edge crosses, and where. Additions of integers are exact in any order: a step from row to
// row, sixteen rows at once, or a product give the same texel.
struct FixedEdge {
  std::uint64_t x = 0, step = 0;     // texels · 2^32, of the first row and from row to row, modulo 2^64
  std::int32_t first = 0, last = 0;  // rows first <= row < last

  // The first texel whose centre is not left of the edge (Herf 1997, section 4.3.1: left and right edges round up
  // alike). Any integer: edges may lie beside the receiver.
  std::int32_t at(std::int32_t row) const {
    const std::uint64_t now = x + static_cast<std::uint64_t>(row - first) * step;
    return static_cast<std::int32_t>(static_cast<std::int64_t>(now) >> 32);
  }
};

// The edge between (ax, ay) and (bx, by), texels, in rows 0 to height. A row's centre that a vertex touches belongs to
// the edge below it. Written without branches, for compilers to do many at once.
[[gnu::always_inline]] inline FixedEdge fixed_edge(double ax, double ay, double bx, double by, double height) {
  constexpr double kMost = 0x1p30;
  const bool down = ay <= by;
  const double x0 = down ? ax : bx, y0 = down ? ay : by, x1 = down ? bx : ax, y1 = down ? by : ay;
  const double first = std::min(std::max(std::ceil(y0 - 0.5), 0.0), height);
  const double last = std::min(std::max(std::ceil(y1 - 0.5), 0.0), height);
  const double slope = std::min(std::max((x1 - x0) / std::max(y1 - y0, 1e-290), -kMost), kMost);
  const double x = std::min(std::max(x0 + ((first + 0.5) - y0) * slope - 0.5, -kMost), kMost);
  FixedEdge edge;
  edge.x = static_cast<std::uint64_t>(static_cast<std::int64_t>(x * 0x1p32)) + 0xffffffffu;  // >> 32 rounds up
  edge.step = static_cast<std::uint64_t>(static_cast<std::int64_t>(slope * 0x1p32));
  edge.first = static_cast<std::int32_t>(first), edge.last = static_cast<std::int32_t>(last);
  return edge;
}

}  // namespace oriel::study
