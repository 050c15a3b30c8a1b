// Seams of the lightmap: edges at which a surface continues on another chart, page or object.
#pragma once

#include "bake/atlas/texel_map.h"
#include "bake/trace/path.h"
#include "formats/assets/lightmap.h"

namespace oriel {

// A surface point with two places on the lightmap.
struct SeamPoint {
  std::array<std::uint32_t, 2> page{};
  std::array<DVec2, 2> place;  // on each page, in texels, inside covered texels
  float length = 0;            // length of seam that it represents, in texels of the finer side
};

struct Seams {
  std::vector<SeamPoint> points;  // about three a texel
  std::size_t pairs = 0;          // of adjoining triangle edges
};

// Finds pairs of chart border edges that coincide in the world, whole or in part, within a tenth of a texel. They may
// be of different charts, pages and objects, or of one chart that is cut open. The surface continues if
// - the edges run in opposite directions, as those of adjacent triangles of one winding do, on the same baked side;
// - the interpolated normals, which the light depends on, agree within 10°, and face normals within 45°;
// - neither side is inside other geometry, and a path from texel to texel, a tenth of a texel above the surface, is
// free: a wall on the seam separates the light of two rooms. Adds to rays. Stage name "seams"; error kStopped.
Result<Seams> find_seams(const Transport& transport, const Atlas& atlas, std::span<const LightmapPage> pages,
                         const Stage& stage);

}  // namespace oriel
