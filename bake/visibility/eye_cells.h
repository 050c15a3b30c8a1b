// The eyes of each eye cell of walk grids.
#pragma once

#include "bake/jobs/context.h"
#include "bake/trace/accel.h"
#include "formats/query/visible_sets.h"

namespace oriel {

// Around the grid's eye height: one who bends, and one on tiptoe or on a step.
inline constexpr float kEyeBelow_m = 0.4f, kEyeAbove_m = 0.2f;

struct CellOfEyes {
  std::vector<Vec3> eyes;   // scene space
  Vec3 lower{0}, upper{0};  // of all eyes that the cell stands for
};

// By eye cell of `side` walk cells a side: `count` eyes (> 0) anywhere over its walk cells and up to a walk cell beside
// them, where nothing is between. Error kStopped.
Result<std::vector<CellOfEyes>> eyes_by_cell(const Accel& accel, std::span<const WalkGrid> grids, std::uint32_t side,
                                             std::uint32_t count, Context& context);

}  // namespace oriel
