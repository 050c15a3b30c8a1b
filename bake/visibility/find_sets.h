// Potentially visible sets by sampled sight lines: docs/notes/visibility.md tells how and what may be missed.
#pragma once

#include "bake/jobs/context.h"
#include "bake/trace/accel.h"
#include "formats/query/visible_sets.h"

namespace oriel {

struct VisibilityOptions {
  float cell_m = 1;  // side of an eye cell; a whole number of walk cells, more where there would be too many
  std::uint32_t most_cells = 4096;
  std::uint32_t group_triangles = 256;  // of a group at most; more where there would be too many
  std::uint32_t most_groups = 4096;
  std::uint32_t first_lines = 64;                      // from a cell to a group, at first
  std::uint32_t least_lines = 128, most_lines = 1024;  // from a cell to a group that may be seen though those missed it
};

// group: by scene triangle, below `groups`.
struct GroupedScene {
  const Accel& accel;
  std::span<const std::uint32_t> group;
  std::uint32_t groups = 0;
};

// Walk cells along each side of an eye cell.
std::uint32_t eye_cell_side(std::span<const WalkGrid> grids, const VisibilityOptions& options);

struct FoundSets {
  std::vector<std::uint8_t> seen;  // as VisibleSets::seen
  std::uint64_t rays = 0;          // traced
};
// For eye cells of `side` walk cells. Error kStopped.
Result<FoundSets> find_visible_sets(const GroupedScene& scene, std::span<const WalkGrid> grids, std::uint32_t side,
                                    const VisibilityOptions& options, Context& context);

// A planar mirror that shows the scene to eyes.
struct SeenMirror {
  Vec4 plane{0, 0, 1, 0};  // height over it: dot(plane, (point, 1)), metres
  float lift = 0;          // height up to which it is the mirror itself
  std::span<const std::uint32_t> triangles;
};

// By mirror one set as above: the groups of which an eye (scene space) may see anything in it. Eyes are mirrored, and
// their lines of sight begin where they cross the mirror. Error kStopped.
Result<FoundSets> find_reflected_sets(const GroupedScene& scene, std::span<const SeenMirror> mirrors,
                                      std::span<const Vec3> eyes, const VisibilityOptions& options, Context& context);

}  // namespace oriel
