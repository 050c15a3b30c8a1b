// The reflection model: Lambert and one GGX lobe, as glTF 2.0 appendix B. Local space: z along the shading normal on the
// side that wo is on; wo and wi point away from the surface.
#pragma once

#include <optional>

#include "bake/scene/shade.h"

namespace oriel {

enum class Lobe : std::uint8_t { kDiffuse, kSpecular, kTransmission };

struct BsdfSample {
  Vec3 wi{0, 0, 1};
  Vec3 weight{0};  // f * |cos θi| / pdf
  float pdf = 0;   // per steradian of all lobes together; 0 where delta
  bool delta = false;
  Lobe lobe = Lobe::kDiffuse;
};

// Fresnel after Schlick 1994: f0 at 0°, f90 at 90°.
Vec3 fresnel_schlick(const Vec3& f0, float f90, float cos_theta);

// Directional albedo of the specular lobe (without Fresnel: a perfect conductor) at cos θ, α: what single scattering
// keeps. Fitted table, absolute error below 0.003; 1 for α = 0.
// f * |cos θi|, delta lobes excluded. 0 where wi or wo is below the horizon.
Vec3 bsdf_eval(const ShadePoint& point, const Vec3& wo, const Vec3& wi);
// Density of bsdf_sample choosing wi, delta lobes excluded.
float bsdf_pdf(const ShadePoint& point, const Vec3& wo, const Vec3& wi);
// A direction in proportion to the lobes' albedo. u: lobe choice; v: direction. Nothing where the surface is black or the
// sample is absorbed.
std::optional<BsdfSample> bsdf_sample(const ShadePoint& point, const Vec3& wo, float u, const Vec2& v);

// Visible normals of GGX, Heitz 2018. alpha > 0. Returns the half vector.
Vec3 sample_ggx_visible_normal(const Vec3& wo, float alpha, const Vec2& u);
// D(h) (per steradian), G1 and G2 (height-correlated Smith).
float ggx_d(float cos_h, float alpha);
float smith_g1(float cos_v, float alpha);
float smith_g2(float cos_o, float cos_i, float alpha);

}  // namespace oriel
