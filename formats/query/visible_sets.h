// What of a building may be seen from where people walk: groups of triangles, and by place a set of groups.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "formats/assets/material.h"
#include "formats/assets/mesh.h"
#include "formats/assets/radiance_map.h"
#include "formats/assets/walk_grid.h"
#include "formats/core/hash.h"

namespace oriel {

// Consecutive triangles of one part. A group is all its runs: some hundred triangles that lie together.
struct TriangleRun {
  std::uint32_t index_count = 0;  // a multiple of 3; runs lie one after the other in Mesh::indices and fill them
  std::uint32_t group = 0;
};

// Potentially visible sets (Airey et al. 1990). Without any in `seen` there are groups alone. An eye cell is a square
// of `side` x `side` walk cells of a grid, where one of them at least is walkable; eye cells are numbered by grid, then
// row by row. Empty where groups is 0.
struct VisibleSets {
  std::uint32_t groups = 0;
  std::vector<TriangleRun> runs;
  std::uint32_t side = 1;          // walk cells along each side of an eye cell
  float below_m = 0, above_m = 0;  // eyes may be so far under and over the grid's eye height
  std::vector<std::uint8_t> seen;  // eye cell by eye cell set_bytes() each; group g is bit g % 8 of byte g / 8
  Hash128 made_for;                // visibility_hash() of a mesh and grids

  bool empty() const { return groups == 0; }
  std::size_t set_bytes() const { return (std::size_t{groups} + 7) / 8; }
};

// By planar reflector what any eye sees in it, drawn where it shows the mirrored scene: groups of VisibleSets.
struct ReflectedSets {
  std::vector<std::uint8_t> seen;  // reflector by reflector VisibleSets::set_bytes() each, bits as there
  Hash128 made_for;                // reflected_hash() of groups and reflectors

  bool empty() const { return seen.empty(); }
};

// By walk grid: the eye cell of each walk cell, -1 where nobody can stand. count: of all eye cells. side: > 0; grids
// valid.
struct EyeCells {
  std::vector<std::vector<std::int32_t>> of_walk_cell;
  std::uint32_t count = 0;
};
EyeCells number_eye_cells(std::span<const WalkGrid> grids, std::uint32_t side);

// Of what sets speak of: positions, indices, floors.
Hash128 visibility_hash(const Mesh& mesh, std::span<const Material> materials, std::span<const WalkGrid> grids);

// Of what reflected sets speak of: the groups, planes and triangles of reflectors.
Hash128 reflected_hash(const VisibleSets& sets, std::span<const Reflector> reflectors);

// Whether sets speak of this mesh and these grids: a program that does not know them may have changed those.
bool made_for(const VisibleSets& sets, const Mesh& mesh, std::span<const Material> materials,
              std::span<const WalkGrid> grids);

// Looks sets up.
class SeenGroups {
 public:
  SeenGroups() = default;
  // The sets and grids must outlive it.
  SeenGroups(const VisibleSets& sets, std::span<const WalkGrid> grids);

  // One byte a group: whether an eye there, pack space, may see it. Of an eye that stands beside a walk cell, by no
  // more than a cell, as of one on it: the sets of all walk cells around it, joined. Nothing: the place is unknown, all
  // may be seen.
  std::optional<std::vector<std::uint8_t>> from(const Vec3& eye) const;

 private:
  const VisibleSets* sets_ = nullptr;
  std::span<const WalkGrid> grids_;
  EyeCells cells_;
};

}  // namespace oriel
