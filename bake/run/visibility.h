// Which triangles are seen from where people walk, in a scene that has enough of them.
#pragma once

#include "bake/run/assemble.h"
#include "bake/run/options.h"
#include "formats/query/visible_sets.h"

namespace oriel {

struct VisibilityReport {
  std::uint32_t cells = 0, groups = 0;
  double seen = 0;  // share of the triangles that an eye cell sees, mean over cells
  std::uint64_t lines = 0;
};

// Why no sets are to be found; empty where they are.
std::string why_not_visible_sets(const BakeOptions& options, std::size_t triangles, std::span<const WalkGrid> grids);

// Sets for the eyes of the grids, unless that takes more than `seconds`; where they pay, mesh's triangles are sorted by
// group within its parts. Where they do not, mesh stays as it is, the sets are empty and `omissions` says why. Error
// kStopped.
Result<VisibleSets> bake_visibility(const BakeOptions& options, const Accel& accel, std::span<const WalkGrid> grids,
                                    AssembledMesh& mesh, double seconds, Context& context, VisibilityReport& report,
                                    std::vector<Warning>& omissions);

}  // namespace oriel
