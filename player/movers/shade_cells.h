// Cells of the scene that stands still, as a binary tree: the sub-patches for which Barczak 2006 ("Realistic Rendering
// of Large Sets of Point Lights", 4.3.1) finds who may block which light, here of any triangles. No OpenGL.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "player/navigation/culling.h"

namespace oriel {

struct ShadeTriangle {
  std::array<Vec3, 3> corners;  // pack space; counter-clockwise from the front
  std::array<Vec3, 3> normals;  // of shading; of any length, the triangle's own where there is none
  bool two_sided = false;
};

struct ShadeCell {
  // A point p belongs to the one leaf with lower <= p < upper. Infinite where the root's outer sides are.
  Bounds cell;
  // Around what of the triangles lies in the cell, with a margin: where rounding moves a point of a surface into the
  // cell beside it, that one's content holds it too. Empty where there is nothing.
  Bounds content;
  // A cone that holds the normals of all of it, shading normals and those between them too. cos_spread: of half its
  // angle, above 0; or -1: any direction, as where something is seen from both sides.
  Vec3 axis{0, 0, 1};
  float cos_spread = -1;
  std::uint32_t child = 0;  // the first of two, which follow each other; 0: a leaf
};

struct ShadeCellLimits {
  float smallest_m = 0.5f;  // cells are not split whose content's longest side is no longer
  std::size_t most = 512;   // leaves
};

// The first is the root, which is there even without triangles; children follow their parents. The cell with the
// longest diagonal is split first, in the middle of its longest side. Triangles without area, or not finite, are left
// out.
std::vector<ShadeCell> make_shade_cells(std::span<const ShadeTriangle> triangles, const ShadeCellLimits& limits);

}  // namespace oriel
