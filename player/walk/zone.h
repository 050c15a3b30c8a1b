// Whether an eye is where reflections were planned for.
#pragma once

#include <span>

#include "formats/assets/walk_grid.h"

namespace oriel {

// An eye may stand this far from the grids' eyes and still see what they see: a cell aside, or a step up or down.
inline constexpr float kZoneHeight_m = 0.5f;

// eye: pack space. True too where there are no grids: nothing was planned, so nothing is left.
bool in_walkable_zone(std::span<const WalkGrid> grids, const Vec3& eye);

}  // namespace oriel
