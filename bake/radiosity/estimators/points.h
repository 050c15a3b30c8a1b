// The points of finer cells as texels of a finer atlas, so that the estimators of texels apply to them.
#pragma once

#include "bake/atlas/texel_map.h"
#include "bake/radiosity/estimators/cells.h"

namespace oriel {

// The points of one level. A point k steps from the centre of texel x is the centre of texel (x + 1) * side + k, on a
// page with `side` times as many texels and a border of one original texel.
struct DetailPoints {
  std::uint32_t side = 0;         // steps along a cell
  Atlas atlas;                    // the same charts on the finer pages
  std::vector<TexelMapPage> map;  // points with a surface

  static std::uint32_t fine(std::uint32_t texel, std::uint32_t step, std::uint32_t side) {
    return (texel + 1) * side + step;
  }
};

// Lists the points of one level. Error kStopped.
Result<DetailPoints> list_points(const Atlas& atlas, const CellLevels& levels, std::uint8_t level, Context& context);

}  // namespace oriel
