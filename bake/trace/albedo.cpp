#include "bake/trace/albedo.h"

#include "bake/trace/glass.h"

namespace oriel {
namespace {

float coat_from_outside(const ShadePoint& point, float cos_theta) {
  if (point.coat <= 0) return 0;
  return point.coat * specular_reflectance(specular_layers(point).coat_lobe(), cos_theta).g;
}

Vec3 from_outside(const ShadePoint& point, float cos_theta) {
  const float coat = coat_from_outside(point, cos_theta);
  if (point.f90 <= 0 && max_component(point.f0) <= 0) return Vec3(coat);
  return Vec3(coat) + (1 - coat) * specular_reflectance(specular_lobe(point), cos_theta);
}

}  // namespace

float coat_reflectance(const ShadePoint& point, float cos_theta) {
  return point.inside ? 0 : coat_from_outside(point, cos_theta);
}

// From within as from outside along the refracted way: both directions of a ray lose the same (Stokes).
Vec3 reflectance(const ShadePoint& point, float cos_theta) {
  if (!point.inside) return from_outside(point, cos_theta);
  const auto outside = refracted_cosine(point.eta, cos_theta);
  return outside ? from_outside(point, static_cast<float>(*outside)) : Vec3(1);
}

Vec3 straight_transmittance(const ShadePoint& point, float cos_theta) {
  const Vec3 through = point.transmission * (1 - max_component(reflectance(point, cos_theta)));
  return Vec3(1 - point.coverage) + point.coverage * through;
}

}  // namespace oriel
