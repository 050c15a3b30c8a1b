// Which side of a double-sided surface its only texels should hold.
#pragma once

#include <span>

#include "bake/atlas/texel_map.h"
#include "bake/trace/path.h"

namespace oriel {

// By chart: 1 where the back of a double-sided surface receives more than twice the light of its front (a wall modelled
// facing outwards, say), found with a few paths from a few of its texels; 0 else. One side for a whole chart, so that
// no edge shows inside it. Adds to rays.
std::vector<char> choose_sides(const Transport& transport, const Atlas& atlas, std::span<const TexelMapPage> texel_map,
                               std::uint64_t seed, std::uint64_t& rays);

// The surface of a texel's point on that side.
SurfacePoint point_on_side(const Scene& scene, const TexelPoint& point, bool back);

}  // namespace oriel
