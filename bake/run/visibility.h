// Which triangles are seen from where people walk, in a scene that has enough of them.
#pragma once

#include "bake/radiance/reflectors.h"
#include "bake/run/assemble.h"
#include "bake/run/task.h"
#include "formats/query/visible_sets.h"

namespace oriel {

struct VisibilityReport {
  std::uint32_t cells = 0, groups = 0;
  double seen = 0;  // share of the triangles that an eye cell sees, mean over cells
  std::uint64_t lines = 0;
};

// Why no sets are to be found; empty where they are.
std::string why_not_visible_sets(const BakeOptions& options, std::size_t triangles, std::span<const WalkGrid> grids);

// Who looks, and into which reflectors.
struct SetEyes {
  std::span<const WalkGrid> grids;
  std::span<const Vec3> eyes;  // scene space
  std::span<const FoundReflector> reflectors;
};

struct SceneSets {
  VisibleSets visible;
  ReflectedSets reflected;                         // of the reflectors; without made_for
  std::vector<std::uint64_t> reflected_triangles;  // by reflector: what its set holds
  VisibilityReport report;
  std::vector<Warning> omissions;
};

// Sets for the eyes of the grids, and of what eyes see in reflectors, unless that takes more than `seconds`; where they
// pay, mesh's triangles are sorted by group within its parts. Where they do not, mesh stays as it is, the sets are
// empty and `omissions` says why. Error kStopped.
Result<SceneSets> bake_visibility(const BakeTask& bake, const SetEyes& onlookers, double seconds, AssembledMesh& mesh);

// Hashes of what a pack's sets are of, so that a reader knows whether they are of what they stand beside.
void hash_sets(Pack& pack);

}  // namespace oriel
