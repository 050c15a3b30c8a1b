// Charts laid flat.
#pragma once

#include <optional>
#include <span>

#include "bake/atlas/patch.h"
#include "bake/atlas/stretch.h"

namespace oriel {

struct FlattenLimits {
  double texel_m = 0;       // the scale of what overlap matters
  double l2 = 1, linf = 1;  // largest stretch of a chart, StretchSum's; a single triangle has none
  double large_m2 = 1e300;  // a chart of more area than this has to fill its box by box_fill, or would leave holes in
  double box_fill = 0;      // a page that only small charts fit in
  bool conformal = true;    // false: projections only, quick, and held to no stretch
};

struct FlatChart {
  std::vector<std::uint32_t> faces;  // of the surface
  std::vector<Triangle2> points;     // by entry of `faces`: metres
  DVec2 size{0};
};

// Lays a connected patch flat without folds, overlaps or too much stretch: projected along its mean normal where that
// is an isometry to half a percent, else by a least-squares conformal map, else projected. Points are in metres,
// counter-clockwise for triangles seen from their front, turned so that the chart's bounding box is small (upright,
// with world +Y towards smaller y, where that is about as small) and wider than high, its lowest corner at (0, 0), and
// the box has that size. None where no way keeps the limits; never for a single triangle. corners: by triangle of the
// patch.
std::optional<FlatChart> flatten(const Patch& patch, std::span<const Triangle3> corners, const FlattenLimits& limits);

}  // namespace oriel
