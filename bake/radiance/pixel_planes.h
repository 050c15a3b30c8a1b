// The planes of the triangles that a radiance map's pixels hit.
#pragma once

#include "bake/radiance/sight.h"

namespace oriel {

// Disparity is linear over the image of a plane: at a pixel's centre, and its change over a pixel along x and y.
struct PixelPlane {
  float disparity = -1;  // below 0: nothing usable is seen
  Vec2 slope{0};
  bool seen() const { return disparity >= 0; }
  // At an offset in pixels from the centre.
  float at(const Vec2& offset) const { return disparity + glm::dot(slope, offset); }
};

// By pixel, of a captured map: those of the surfaces along its rays that lie where its disparities say. The sky's slope
// is 0, and so is that of what is found no more.
std::vector<PixelPlane> find_planes(const ReflectedSurroundings& surroundings, const RadianceMap& map);

}  // namespace oriel
