#include "bake/brdf/fresnel.h"

#include <complex>

namespace oriel {
namespace {

constexpr float kWidest = 0.8f, kLeastHighlight = 0.03f / (0.25f * 0.25f);  // α; reflectance / α²

// (F(θ) - F(0)) / (1 - F(0)); F(0) = 1 leaves no room to rise.
double rise(double f, double f0) {
  return f0 < 1 ? (f - f0) / (1 - f0) : 0;
}

}  // namespace

double fresnel_dielectric(double eta, double cos_theta) {
  if (eta == 1) return 0;
  const double c = std::clamp(cos_theta, 0.0, 1.0), difference = (eta - 1) * (eta + 1);
  const double g2 = difference + c * c;
  if (g2 <= 0 || c == 0) return 1;
  const double g = std::sqrt(g2);
  const double s = difference / ((c + g) * (c + g));  // (g - c) / (g + c) without the difference
  const double p = (eta * eta * c - g) / (eta * eta * c + g);
  return std::min(1.0, 0.5 * (s * s + p * p));
}

PolarisedReflectance polarised_reflectance(const ComplexIndex& index, double cos_theta) {
  const auto [n, k] = index;
  if (n == 1 && k == 0) return {};
  const double c = std::clamp(cos_theta, 0.0, 1.0);
  const std::complex<double> eta2((n - k) * (n + k), 2 * n * k);
  const std::complex<double> g = std::sqrt(std::complex<double>((n - 1) * (n + 1) - k * k + c * c, 2 * n * k));
  return {std::norm((c - g) / (c + g)), std::norm((eta2 * c - g) / (eta2 * c + g))};
}

double fresnel_conductor(const ComplexIndex& index, double cos_theta) {
  if (index.k == 0) return fresnel_dielectric(index.n, cos_theta);
  const auto [s, p] = polarised_reflectance(index, cos_theta);
  return std::min(1.0, 0.5 * (s + p));
}

double schlick_weight(double cos_theta) {
  const double m = std::clamp(1 - cos_theta, 0.0, 1.0), m2 = m * m;
  return m2 * m2 * m;
}

double dielectric_f0(double eta) {
  const double r = (eta - 1) / (eta + 1);
  return r * r;
}

DVec3 metal_f0(Metal metal) {
  DVec3 f0;
  for (int c = 0; c < 3; ++c) f0[c] = fresnel_conductor(constants_of(metal).rgb[static_cast<std::size_t>(c)], 1);
  return f0;
}

DVec3 fresnel_weight(const FresnelCurve& curve, double cos_theta) {
  if (curve.metal != Metal::kNone) {
    DVec3 w;
    for (int c = 0; c < 3; ++c) {
      const ComplexIndex& index = constants_of(curve.metal).rgb[static_cast<std::size_t>(c)];
      w[c] = rise(fresnel_conductor(index, cos_theta), fresnel_conductor(index, 1));
    }
    return w;
  }
  const double schlick = schlick_weight(cos_theta);
  if (!(curve.ior > 0) || curve.schlick >= 1) return DVec3(schlick);
  const double exact = rise(fresnel_dielectric(curve.ior, cos_theta), dielectric_f0(curve.ior));
  return DVec3(exact + curve.schlick * (schlick - exact));
}

float reflectance_at_60_deg(const Vec3& f0, float f90, const FresnelCurve& curve) {
  return max_component(glm::mix(f0, Vec3(f90), Vec3(fresnel_weight(curve, 0.5))));
}

bool shows_highlights(float reflectance, float alpha) {
  return alpha < kWidest && reflectance >= kLeastHighlight * alpha * alpha;
}

}  // namespace oriel
