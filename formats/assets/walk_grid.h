// Where a person can stand: the eyes that radiance maps are planned for.
#pragma once

#include <cmath>
#include <vector>

#include "formats/core/vec.h"

namespace oriel {

// One storey of the walkable floor as a grid over pack space's x and z. Cell (i, j) is at j * width + i, its centre at
// lower + (i + ½, j + ½) * cell_m.
struct WalkGrid {
  Vec2 lower{0};     // x, z of the grid's corner, metres
  float cell_m = 0;  // side of a cell, > 0
  std::uint32_t width = 0, height = 0;
  std::vector<float> floor_y;  // width * height: height of the floor, metres; NaN where nobody can stand
  float eye_height_m = 1.6f;   // of eyes over the floor

  bool walkable(std::size_t cell) const { return !std::isnan(floor_y[cell]); }
  // The eye over the middle of a walkable cell.
  Vec3 eye(std::size_t cell) const {
    const Vec2 at = lower + (Vec2(cell % width, cell / width) + 0.5f) * cell_m;
    return {at.x, floor_y[cell] + eye_height_m, at.y};
  }
  double walkable_m2() const {
    std::size_t cells = 0;
    for (std::size_t c = 0; c < floor_y.size(); ++c) cells += walkable(c);
    return static_cast<double>(cells) * cell_m * cell_m;
  }
};

}  // namespace oriel
