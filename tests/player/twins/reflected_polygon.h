// What a glossy lobe reflects of a polygon of light, as shaders/lib/lobe_light.glsl has it.
#pragma once

#include <span>

#include "formats/core/check.h"
#include "formats/query/clipped_polygon.h"
#include "formats/query/lobe_light.h"

namespace oriel {

// The integral of the lobe over the part of a polygon above the surface: what it reflects of a radiance of 1, without
// Fresnel, [0, fit.amplitude] up to rounding. corners: 3 or 4, convex, relative to the point; counter-clockwise as seen
// from it: positive, else negative.
inline float reflected_polygon(const LobeFit& fit, std::span<const Vec3> corners) {
  ORIEL_CHECK(corners.size() == 3 || corners.size() == 4);
  constexpr Vec3 kUp(0, 0, 1);
  ClippedPolygon polygon;
  for (const Vec3& corner : corners) polygon.v[polygon.count++] = corner;
  polygon = clip(polygon, kUp);
  for (int i = 0; i < polygon.count; ++i) {
    const Vec3 w = polygon.v[i];
    const Vec3 v(fit.m11 * w.x + fit.m13 * w.z, fit.m22 * w.y, fit.m31 * w.x + w.z);
    polygon.v[i] = normalize_or(v, Vec3(0));
  }
  polygon = clip(polygon, kUp);
  if (polygon.count < 3) return 0;
  return -fit.amplitude / kPi * polygon_vector(polygon).z;
}

}  // namespace oriel
