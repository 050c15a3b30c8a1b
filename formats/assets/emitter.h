// Surfaces that shine: what glossy reflectors show in closed form instead of in their radiance maps.
#pragma once

#include <vector>

#include "formats/core/vec.h"

namespace oriel {

// A convex planar polygon of even radiance.
struct Emitter {
  std::vector<Vec3> corners;  // 3 or 4, pack space, counter-clockwise seen from the bright side
  Vec3 radiance{0};           // cd/m², linear Rec. 709, the mean over the polygon
  bool two_sided = false;     // shines from its back as well
};

}  // namespace oriel
