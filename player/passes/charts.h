// The charts of lightmap pages: connected parts of the layout. No OpenGL.
#pragma once

#include <vector>

#include "formats/pack/pack.h"

namespace oriel {

inline constexpr std::uint32_t kNoChart = 0xffffffff;

// By triangle of the mesh (first index / 3): the number of its chart, from 0 in the order of triangles; kNoChart where
// its part has no lightmap. Triangles that share a corner on one page are one chart.
std::vector<std::uint32_t> charts_of(const Mesh& mesh);

// By page its texels' colours, RGBA8 as shown: one for each chart, as different as they can be from those before it;
// all texels that a triangle touches, black elsewhere.
std::vector<std::vector<std::uint8_t>> chart_colors(const Pack& pack);

// A chart's colour, sRGB as shown, [0, 1].
Vec3 chart_color(std::uint32_t chart);

}  // namespace oriel
