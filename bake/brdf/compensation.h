// What single scattering loses: light that is shadowed between facets would leave after further bounces. A lobe f is
// scaled by s(θo) s(θi), with s solved so that a lobe without absorption reflects exactly all it receives at every
// angle (∫ f s(θo) s(θi) cosθi dωi = 1: Sinkhorn's symmetric balancing). As Turquin 2019, "Practical multiple
// scattering compensation for microfacet models", this keeps the lobe's shape, so that a kernel and a reflectance can
// stand for it; unlike his 1 / E(θo) it is reciprocal.
#pragma once

#include <array>
#include <functional>

#include "bake/brdf/microfacet.h"

namespace oriel {

// A reciprocal isotropic BRDF times cosθi, without Fresnel's factor: f(wo, wi, h).
using LobeFunction = std::function<double(const DVec3& wo, const DVec3& wi, const DVec3& h)>;
struct CosineLobe {
  LobeFunction f_cos;
  double width = 1;  // in slopes of half vectors, (0, 1]
};

class Compensation {
 public:
  // order: of the quadrature, see for_each_reflection(); GGX needs 12, Beckmann 24 for 1e-4.
  Compensation(const CosineLobe& lobe, int order);
  Compensation(const Microfacet& isotropic, int order = 24);

  // s and the single-scattering albedo E at a cosine in [0,1]: interpolated, to 2e-3.
  double scale(double cos_theta) const { return at(scale_, cos_theta); }
  double albedo(double cos_theta) const { return at(albedo_, cos_theta); }

  // Nodes of the tables are even in q = cosθ (1 + α) / (cosθ + α): where α is small, albedos depend on cosθ / α alone.
  static constexpr int kNodes = 96;
  static double coordinate(double width, double cos_theta) {
    return cos_theta * (1 + width) / (cos_theta + width) * (kNodes - 1);
  }
  const std::array<double, kNodes>& scales() const { return scale_; }
  const std::array<double, kNodes>& albedos() const { return albedo_; }

 private:
  double at(const std::array<double, kNodes>& table, double cos_theta) const;

  double width_;
  std::array<double, kNodes> scale_{}, albedo_{};
};

}  // namespace oriel
