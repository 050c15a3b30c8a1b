// Between the spaces of pack, reflector and radiance map (Bastos et al. 1999, section 8.1.3).
#pragma once

#include "formats/query/reflector_nodes.h"

namespace oriel {

inline constexpr float kSameDisparity = 0.03f;  // relative: of a sample and a pixel that holds it, or beside it

// The mirror image in the reflector's plane, reflector space.
inline Vec3 mirrored(const Vec3& p) {
  return {p.x, p.y, -p.z};
}

// The point of the element's rectangle under a pixel position; centres are at i + ½.
Vec2 map_point(const RadianceMap& map, const Vec2& pixel);
// The pixel position under which the map's eye sees p (reflector space, p.z > eye.z).
Vec2 map_pixel(const RadianceMap& map, const Vec3& p);
// Disparity of a point at height z above the plane: e / (e + z) with e the eye's distance from the plane.
float disparity_of(const RadianceMap& map, float z);
// The scene point of a pixel, reflector space, homogeneous: w is the disparity, so that w = 0 is a direction (sky).
Vec4 unproject(const RadianceMap& map, const Vec2& pixel, float disparity);

}  // namespace oriel
