// Fresnel's equations for unpolarised light, and the curves that a material's specular lobe follows. Cosines are of the
// angle between a direction and the (micro-)surface's normal, in [0,1]; beyond they are clamped. Results in [0,1].
#pragma once

#include "bake/brdf/metals.h"
#include "formats/core/vec.h"

namespace oriel {

// eta: index behind the surface over index before it, > 0. 1 beyond the critical angle (eta < 1); at 90° exactly 1, but
// 0 everywhere where eta = 1.
double fresnel_dielectric(double eta, double cos_theta);

// The exact equations for a complex index, n >= 0 and k >= 0 not both 0. At 90° exactly 1, but 0 everywhere where
// n = 1, k = 0. The root is taken of (η² - 1) + cos²θ: the usual η² - sin²θ cancels at grazing angles where η is
// near 1.
double fresnel_conductor(const ComplexIndex& index, double cos_theta);
// Its parts: light polarised across (s) and in (p) the plane of incidence.
struct PolarisedReflectance {
  double s = 0, p = 0;
};
PolarisedReflectance polarised_reflectance(const ComplexIndex& index, double cos_theta);

double schlick_weight(double cos_theta);  // (1 - cosθ)^5: Schlick 1994

// Reflectance of a smooth dielectric at normal incidence: ((eta - 1) / (eta + 1))².
double dielectric_f0(double eta);

// How the specular reflectance goes from f0 at 0° to f90 at 90°: F = f0 + (f90 - f0) w(θ). With the exact equations
// w = (F(θ) - F(0)) / (1 - F(0)), so that F is exact where f0 = F(0) and f90 = 1, and a tint of f0 or a weight of both
// (KHR_materials_specular) keeps the curve's shape.
struct FresnelCurve {
  float ior = 0;               // of a dielectric; 0: none, the curve is all Schlick's
  float schlick = 1;           // share of Schlick's curve beside the dielectric's: of the metal in a glTF mixture
  Metal metal = Metal::kNone;  // then neither of the above

  bool operator==(const FresnelCurve&) const = default;
};

// w per channel.
DVec3 fresnel_weight(const FresnelCurve& curve, double cos_theta);
// f0 of a metal per channel.
DVec3 metal_f0(Metal metal);

// Largest channel of F at 60°.
float reflectance_at_60_deg(const Vec3& f0, float f90, const FresnelCurve& curve);

// Whether a lobe of that reflectance and width shows where lamps are. What it shows of a small lamp goes as
// reflectance / α²: it does where that is no less than in a lobe of 3 % and roughness 0.5, as plastics' up to 0.65.
// Metals' do up to 0.9. Wider ones are nearer to even light than to what taps of a map make of them.
bool shows_highlights(float reflectance, float alpha);

}  // namespace oriel
