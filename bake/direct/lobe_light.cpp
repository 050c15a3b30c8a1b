#include "bake/direct/lobe_light.h"

#include <algorithm>

#include "bake/direct/clipped_polygon.h"
#include "formats/core/check.h"

namespace oriel {

double lobe_density(const LobeFit& fit, const DVec3& w) {
  const DVec3 v(fit.m11 * w.x + fit.m13 * w.z, fit.m22 * w.y, fit.m31 * w.x + w.z);
  const double determinant = double{fit.m22} * (fit.m11 - double{fit.m13} * fit.m31), length2 = glm::dot(v, v);
  return std::max(v.z, 0.0) * determinant / (kPiD * length2 * length2);
}

float reflected_polygon(const LobeFit& fit, std::span<const Vec3> corners) {
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
