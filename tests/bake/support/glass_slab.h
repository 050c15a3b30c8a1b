// Closed forms of a slab of glass with parallel sides.
#pragma once

#include "bake/brdf/fresnel.h"
#include "bake/trace/glass.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel::test {

// Smooth, of index 1.5 unless told. absorption: 1/m.
inline SceneMaterial solid_glass(float ior = 1.5f, const Vec3& absorption = Vec3(0), float roughness = 0) {
  SceneMaterial m;
  m.metallic = 0, m.roughness = roughness, m.transmission = 1;
  m.ior = ior, m.solid = true, m.absorption = absorption;
  return m;
}

// What it passes at that cosine: its faces and all that goes to and fro between them (Born and Wolf, incoherent).
// optical_depth: absorption times thickness.
inline double slab_transmittance(double ior, double cos_theta, double optical_depth = 0) {
  const double r = fresnel_dielectric(ior, cos_theta);
  const double a = std::exp(-optical_depth / *refracted_cosine(ior, cos_theta));
  return (1 - r) * (1 - r) * a / (1 - r * r * a * a);
}

// Irradiance below an endless one under an even sky of radiance 1: ∫ T cosθ dω, in steps of sin²θ.
inline double slab_irradiance(double ior, double optical_depth = 0) {
  constexpr int kSteps = 2000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i)
    sum += kPiD / kSteps * slab_transmittance(ior, std::sqrt(1 - (i + 0.5) / kSteps), optical_depth);
  return sum;
}

}  // namespace oriel::test
