#include "bake/trace/shading.h"

namespace oriel {
namespace {

// z along the normal, x along the tangent where there is one.
Mat3 frame_of(const SurfacePoint& surface) {
  const Vec3 across = surface.tangent - glm::dot(surface.tangent, surface.normal) * surface.normal;
  const float size2 = length2(across);
  if (!(size2 > 1e-12f)) return frame_from_normal(surface.normal);
  const Vec3 x = across / std::sqrt(size2);
  return {x, glm::cross(surface.normal, x), surface.normal};
}

}  // namespace

Shading::Shading(const SurfacePoint& surface, const Vec3& wo_world)
    : surface_(surface),
      frame_(frame_of(surface)),
      wo_(glm::transpose(frame_) * wo_world),
      tilted_(glm::dot(surface.normal, surface.geometric_normal) < 1 - 1e-6f) {}

}  // namespace oriel
