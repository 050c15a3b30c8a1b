// A radiance map's depth as triangles, which a rasteriser draws with the map's light as their texture.
#pragma once

#include <vector>

#include "formats/core/vec.h"

namespace oriel {

// A vertex is (x, y, disparity): x and y from 0 to 1 over the map's width and height, disparity as RadianceMap has it.
// These are projective coordinates of the scene: planes are planes in them, and the vertex lies at the homogeneous
// point (q - eye + disparity * eye, disparity), q the point of the element's rectangle under (x, y).
// Triangles are counter-clockwise in x and y: the side that the map's eye saw. Surfaces that are not connected share no
// vertex. What the map did not see has no triangle.
struct MapMesh {
  std::vector<Vec3> vertices;
  std::vector<std::uint32_t> indices;
};

}  // namespace oriel
