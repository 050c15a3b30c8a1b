// The points of finer cells as texels of a finer atlas, so that all that estimates light of texels does of them too.
#pragma once

#include <functional>

#include "bake/atlas/texel_map.h"
#include "bake/radiosity/estimators/cells.h"

namespace oriel {

// The points of the cells of one level. A point k steps from the centre of texel x is the middle of texel
// (x + 1) * side + k of a page with `side` times as many texels, and one more of the old ones around it.
struct DetailPoints {
  std::uint32_t side = 0;         // steps along a cell
  Atlas atlas;                    // the same charts on the finer pages
  std::vector<TexelMapPage> map;  // of the points that have some surface

  static std::uint32_t fine(std::uint32_t texel, std::uint32_t step, std::uint32_t side) {
    return (texel + 1) * side + step;
  }
};

// Whether point (i, j) of the cell at a place of a page is wanted.
using PointFilter = std::function<bool(std::uint32_t page, std::uint32_t place, std::uint32_t i, std::uint32_t j)>;

// Error kStopped.
Result<DetailPoints> list_points(const Atlas& atlas, const CellLevels& levels, std::uint8_t level,
                                 const PointFilter& wants, Context& context);

}  // namespace oriel
