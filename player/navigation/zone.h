// Whether an eye is where reflections were planned for.
#pragma once

#include <optional>
#include <vector>

#include "formats/pack/pack.h"

namespace oriel {

// An eye may stand this far from the grids' eyes and still see what they see: a cell aside, or a step up or down.
inline constexpr float kZoneHeight_m = 0.5f;
// And so far from an eye that was given: maps are judged by eyes up to 20 cm away along each axis.
inline constexpr float kZoneRadius_m = 0.35f;

// Where reflections were planned for, pack space: near the grids' eyes or those that were given, or in the box.
struct Zone {
  std::vector<WalkGrid> grids;
  std::vector<Vec3> eyes;
  struct Box {
    Vec3 lower{0}, upper{0};
  };
  std::optional<Box> box;

  // True too where nothing is known: nothing was planned, so nothing is left.
  bool holds(const Vec3& eye) const;
};

// As `oriel-bake --eyes` made the pack: people on its walk grids and its cameras and paths; the eyes of a file; the
// scene's box. Of a pack that does not say so its walk grids count.
Zone planned_zone(const Pack& pack);

}  // namespace oriel
