// The reflection of a shading point: Lambert, a GGX lobe with exact Fresnel, a clear coat and thin straight
// transmission (docs/materials.md). Local space: z along the shading normal on the side that wo is on, x along the wide
// direction of an anisotropic lobe; wo and wi point away from the surface.
#pragma once

#include <optional>

#include "bake/trace/albedo.h"

namespace oriel {

enum class Lobe : std::uint8_t { kDiffuse, kSpecular, kTransmission };

struct BsdfSample {
  Vec3 wi{0, 0, 1};
  Vec3 weight{0};  // f * |cos θi| / pdf, lobe choice included
  float pdf = 0;   // per steradian of all lobes together; 0 where delta
  bool delta = false;
  Lobe lobe = Lobe::kDiffuse;
};

// f * cos θi, delta lobes excluded. 0 where wi or wo is below the horizon.
Vec3 bsdf_eval(const ShadePoint& point, const Vec3& wo, const Vec3& wi);
// Density of bsdf_sample choosing wi, delta lobes excluded.
float bsdf_pdf(const ShadePoint& point, const Vec3& wo, const Vec3& wi);
// A direction in proportion to the lobes' albedo. u: lobe choice; v: direction. Transmission is wi = -wo, delta.
// Nothing where the surface is black or the sample falls below the horizon.
std::optional<BsdfSample> bsdf_sample(const ShadePoint& point, const Vec3& wo, float u, const Vec2& v);

}  // namespace oriel
