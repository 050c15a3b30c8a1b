// Pixels of a radiance map as points in space: the same maths as shaders/lib/reprojection.glsl.
// Reflector space throughout: the plane is z = 0, the reflected world z > 0, the maps' eyes z < 0.
#pragma once

#include "formats/core/vec.h"

namespace oriel {

// The point that a pixel saw, homogeneous: xyz / w, or the direction xyz where w = 0. on_plane: where the pixel's ray
// crosses the plane; disparity as in RadianceMap.
inline Vec4 map_point(const Vec3& eye, const Vec2& on_plane, float disparity) {
  return Vec4(disparity * eye + Vec3(on_plane, 0) - eye, disparity);
}

}  // namespace oriel
