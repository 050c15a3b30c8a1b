#include "bake/trace/glass.h"

#include <algorithm>

#include "bake/trace/albedo.h"

namespace oriel {
namespace {

constexpr float kParallel = 1e-4f;  // 1 - the cosine between sides of a slab

Vec3 beer(const Vec3& absorption, float metres) {
  return glm::exp(-absorption * std::max(metres, 0.0f));
}

}  // namespace

std::optional<double> refracted_cosine(double eta, double cos_theta) {
  const double c = std::clamp(cos_theta, 0.0, 1.0);
  const double square = ((eta - 1) * (eta + 1) + c * c) / (eta * eta);  // as fresnel_dielectric has it
  if (square < 0) return std::nullopt;
  return std::sqrt(std::min(square, 1.0));
}

std::optional<DVec3> refract_about(const DVec3& wo, const DVec3& h, double eta) {
  const double cosine = glm::dot(wo, h);
  const auto beyond = refracted_cosine(eta, cosine);
  if (!beyond || !(cosine > 0)) return std::nullopt;
  return glm::normalize((cosine / eta - *beyond) * h - wo / eta);
}

Vec3 Medium::passed(const Scene& scene, const Hit& hit) const {
  if (!hit.front) {
    const SceneMaterial& m = scene.material_of(hit.triangle);
    if (m.solid) return beer(m.absorption, hit.distance);
  }
  return inside_ ? beer(absorption_, hit.distance) : Vec3(1);
}

Vec3 StraightGlass::meet(const ShadePoint& point, bool front, const Vec3& normal, const Vec3& direction,
                         float distance) {
  length_ += distance;
  const float cosine = std::abs(glm::dot(normal, direction));
  if (!(point.eta > 0)) return straight_transmittance(point, cosine);
  if (!front) return leave(point, normal, cosine);
  const Vec3 before = end(0);
  inside_ = true, length_ = 0, normal_ = normal, absorption_ = point.absorption;
  return before * straight_transmittance(point, cosine);
}

Vec3 StraightGlass::leave(const ShadePoint& point, const Vec3& normal, float cosine) {
  const Vec3 passed = straight_transmittance(point, cosine);
  const bool slab = inside_ && glm::dot(normal, normal_) < kParallel - 1;
  const float length = length_;
  inside_ = false, length_ = 0;
  if (!slab) return passed * beer(point.absorption, length);
  const auto within = static_cast<float>(*refracted_cosine(std::max(point.eta, 1.0f), cosine));
  const Vec3 absorbed = beer(point.absorption, length * cosine / std::max(within, 1e-6f));
  const float reflected = max_component(reflectance(point, cosine));
  return passed * absorbed / glm::max(1.0f - reflected * reflected * absorbed * absorbed, Vec3(1e-6f));
}

Vec3 StraightGlass::end(float distance) const {
  return inside_ ? beer(absorption_, length_ + distance) : Vec3(1);
}

}  // namespace oriel
