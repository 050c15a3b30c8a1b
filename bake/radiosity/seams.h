// Where a surface goes on across charts, pages and objects, so that its light is continuous there.
#pragma once

#include "bake/atlas/texel_map.h"
#include "bake/trace/path.h"
#include "formats/assets/lightmap.h"

namespace oriel {

// A point of the surface that lies at two places of the lightmap.
struct SeamPoint {
  std::array<std::uint32_t, 2> page{};
  std::array<DVec2, 2> place;  // in texels of the page, inside the covered texels of its side
  float length = 0;            // of seam that it stands for, in texels of the finer side
};

struct Seams {
  std::vector<SeamPoint> points;  // about three a texel
  std::size_t pairs = 0;          // of triangle edges that meet
};

// Rim edges of charts that run along each other in the world, whole or in part, within a tenth of a texel: of different
// charts, pages and objects, or of one chart that is cut open. The surface goes on where
// - the edges run in opposite directions, as those of neighbours of one winding do, and the same side is baked on both;
// - the interpolated normals, which the light depends on, agree within 10°, and those of the faces within 45°;
// - neither side is inside other geometry, and a path from texel to texel, a tenth of a texel above the surface, is
//   free: a wall standing on the seam parts the light of two rooms.
// Adds to rays. Stage name "seams"; error kStopped.
Result<Seams> find_seams(const Transport& transport, const Atlas& atlas, std::span<const LightmapPage> pages,
                         const Stage& stage);

}  // namespace oriel
