// The reflection model: Lambert, one GGX lobe and thin straight transmission (docs/conventions.md, "Materials").
// Local space: z along the shading normal on the side that wo is on; wo and wi point away from the surface.
#pragma once

#include <optional>

#include "bake/scene/shade.h"

namespace oriel {

// Lobes narrower than this are treated as a perfect mirror: their D would exceed what float sums can carry.
inline constexpr float kMirrorAlpha = 1e-4f;

enum class Lobe : std::uint8_t { kDiffuse, kSpecular, kTransmission };

struct BsdfSample {
  Vec3 wi{0, 0, 1};
  Vec3 weight{0};  // f * |cos θi| / pdf, lobe choice included
  float pdf = 0;   // per steradian of all lobes together; 0 where delta
  bool delta = false;
  Lobe lobe = Lobe::kDiffuse;
};

// Fresnel after Schlick 1994: f0 at 0°, f90 at 90°.
Vec3 fresnel_schlick(const Vec3& f0, float f90, float cos_theta);

// f * cos θi, delta lobes excluded. 0 where wi or wo is below the horizon.
Vec3 bsdf_eval(const ShadePoint& point, const Vec3& wo, const Vec3& wi);
// Density of bsdf_sample choosing wi, delta lobes excluded.
float bsdf_pdf(const ShadePoint& point, const Vec3& wo, const Vec3& wi);
// A direction in proportion to the lobes' albedo. u: lobe choice; v: direction. Transmission is wi = -wo, delta.
// Nothing where the surface is black or the sample falls below the horizon.
std::optional<BsdfSample> bsdf_sample(const ShadePoint& point, const Vec3& wo, float u, const Vec2& v);

// Visible normals of GGX, Heitz 2018. alpha > 0, wo.z > 0. Returns the half vector.
Vec3 sample_ggx_visible_normal(const Vec3& wo, float alpha, const Vec2& u);
// D(h) per steradian; G1 and height-correlated G2 of Smith. Cosines in (0,1], alpha > 0.
float ggx_d(float cos_h, float alpha);
float smith_g1(float cos_v, float alpha);
float smith_g2(float cos_o, float cos_i, float alpha);

}  // namespace oriel
