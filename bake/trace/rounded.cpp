#include "bake/trace/rounded.h"

namespace oriel {
namespace {

// Normals of a column of six sides or more round it; those of a box with normals shared at its corners do not.
constexpr float kRound = 0.8f;  // cosine between facet and normal, at least

}  // namespace

float height_of_rounded(const Accel& accel, const SurfacePoint& surface) {
  if (surface.normal == surface.geometric_normal) return 0;
  const Scene& scene = accel.scene();
  const Vec3 &point = surface.position, &geometric_normal = surface.geometric_normal;
  const UVec3& t = scene.triangles[surface.triangle];
  const auto corner = [&](int i) { return scene.positions[t[i % 3]]; };
  const Vec3 twice_area = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
  const float side = glm::dot(twice_area, geometric_normal);  // twice the area, < 0 for the back
  if (!(std::abs(side) > 0)) return 0;
  float height = 0;
  for (int i = 0; i < 3; ++i) {
    const Vec3 normal = std::copysign(1.0f, side) * scene.normals[t[i]];
    const float cosine = glm::dot(normal, geometric_normal);
    if (cosine < kRound) return 0;
    const float weight = glm::dot(glm::cross(corner(i + 1) - point, corner(i + 2) - point), geometric_normal) / side;
    height -= std::clamp(weight, 0.0f, 1.0f) * std::min(0.0f, glm::dot(point - corner(i), normal)) * cosine;
  }
  if (!(height > 0)) return 0;
  const Ray way{spawn_origin(surface, geometric_normal), geometric_normal, height};
  return accel.transmittance(way) == Vec3(1) ? height : 0;
}

}  // namespace oriel
