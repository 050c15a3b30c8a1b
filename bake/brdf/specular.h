// R: the directional albedo of a material's specular lobe (GGX, height-correlated Smith, compensated), exact by
// quadrature for tables that are baked and interpolated for paths.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "bake/brdf/compensation.h"
#include "bake/brdf/fresnel.h"

namespace oriel {

// Lobes narrower than this are treated as a perfect mirror.
inline constexpr float kMirrorAlpha = 1e-4f;

struct SpecularLobe {
  Vec3 f0{0.04f};  // reflectance at normal incidence, [0,1]
  float f90 = 1;   // at grazing incidence, [0,1]
  float alpha = 1;
  FresnelCurve curve = {};
};

// A lobe under a clear coat of index 1.5 that covers a share of the surface. The coat takes its R of what arrives, at
// the viewing angle; its own lower side is not followed.
struct SpecularLayers {
  SpecularLobe base;
  float coat = 0, coat_alpha = 0;  // [0,1]
  SpecularLobe coat_lobe() const { return {Vec3(0.04f), 1, coat_alpha, {.ior = 1.5f, .schlick = 0}}; }
};

// F per channel.
Vec3 specular_fresnel(const SpecularLobe& lobe, double cos_theta);
// What compensation multiplies the lobe with where s(θo) s(θi) = scale: the share f0 of the lost light comes back.
inline Vec3 compensated(const Vec3& f0, float scale) {
  return Vec3(1) + f0 * (scale - 1);
}

struct Albedo {
  DVec3 single{0};       // single scattering alone
  DVec3 compensated{0};  // R; above 1 by 1e-3 at most where the lobe itself is bounded
};
// F(cosθd) per channel, and its value at 0°.
struct LobeFresnel {
  std::function<DVec3(double)> at;
  DVec3 f0;
};
// ∫ F f cosθi dωi of a lobe, without and with `compensation` of it, by quadrature of `order`; cos_theta in (0,1].
Albedo lobe_albedo(const CosineLobe& lobe, const Compensation& compensation, const LobeFresnel& fresnel,
                   double cos_theta, int order = 24);

// R of a lobe at any cosine in [0,1], error below 2e-4: for tables.
class ExactReflectance {
 public:
  explicit ExactReflectance(const SpecularLobe& lobe);
  Vec3 operator()(double cos_theta) const;

 private:
  SpecularLobe lobe_;
  std::optional<Compensation> compensation_;  // none: a mirror
  std::vector<DVec3> weights_;                // of the curve, even in √cosθ
};

// The same from tables that are made once: errors below 2e-3, but where a curve has a step at grazing angles (an index
// within 1e-3 of 1).
Vec3 specular_reflectance(const SpecularLobe& lobe, float cos_theta);
// s of the GGX lobe.
double ggx_scale(double alpha, double cos_theta);

}  // namespace oriel
