// The points of finer cells as texels of a finer atlas, so that all that estimates light of texels does of them too.
#pragma once

#include <functional>

#include "bake/atlas/texel_map.h"
#include "bake/radiosity/estimators/cells.h"

namespace oriel {

// All points of the cells of one level. A point k steps from the centre of texel x is the middle of texel
// (x + 1) * side + k of a page with `side` times as many texels, and one more of the old ones around it.
struct DetailPoints {
  std::uint32_t side = 0;         // steps along a cell
  Atlas atlas;                    // the same charts on the finer pages
  std::vector<TexelMapPage> map;  // of the points that have some surface

  static std::uint32_t fine(std::uint32_t texel, std::uint32_t step, std::uint32_t side) {
    return (texel + 1) * side + step;
  }
};

// Error kStopped.
Result<DetailPoints> list_points(const Atlas& atlas, const CellLevels& levels, std::uint8_t level, Context& context);

}  // namespace oriel
