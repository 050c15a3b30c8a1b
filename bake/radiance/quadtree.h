// A map's surfaces as squares: planar parts in large ones.
#pragma once

#include "bake/radiance/surface_grid.h"

namespace oriel {

// A mesh over a map: (x, y) in pixels, and disparity times SurfaceGrid::pixels_of_disparity().
struct GridMesh {
  std::vector<Vec3> positions;
  std::vector<Vec2> slopes;          // of the third coordinate, by pixel
  std::vector<std::uint8_t> behind;  // SurfaceGrid::Vertex's
  std::vector<std::uint32_t> indices;
};

// The squares of a quadtree that are planar and connected, and pixels elsewhere, without cracks between neighbours that
// are connected. Triangles are counter-clockwise.
GridMesh mesh_squares(const SurfaceGrid& grid);

}  // namespace oriel
