// What a shading point's specular layers reflect and let through (brdf/specular.h).
#pragma once

#include "bake/brdf/specular.h"
#include "bake/scene/shade.h"

namespace oriel {

// The widths of an anisotropic lobe along and across its wide direction.
inline float wide_alpha(float alpha, float anisotropy) {
  return alpha + (1 - alpha) * anisotropy * anisotropy;
}
inline float wide_alpha(const ShadePoint& point) {
  return wide_alpha(point.alpha, point.anisotropy);
}
// An anisotropic lobe has the albedo of the isotropic one of the same area in slopes, nearly.
inline float mean_alpha(float alpha, float anisotropy) {
  return anisotropy > 0 ? std::sqrt(alpha * wide_alpha(alpha, anisotropy)) : alpha;
}
inline SpecularLobe specular_lobe(const ShadePoint& point) {
  return {point.f0, point.f90, mean_alpha(point.alpha, point.anisotropy), point.curve};
}
inline SpecularLayers specular_layers(const ShadePoint& point) {
  return {specular_lobe(point), point.coat, point.coat_alpha};
}

// R of the coat alone times its share, [0,1]; 0 from within solid glass.
float coat_reflectance(const ShadePoint& point, float cos_theta);
// R of all specular layers per channel, [0,1]; 1 beyond the critical angle from within solid glass.
Vec3 reflectance(const ShadePoint& point, float cos_theta);

// Share of light that passes straight through a surface at that incidence: what coverage leaves open, and thin
// transmission after Fresnel. Of solid glass one of its surfaces, as if light went on unbent.
Vec3 straight_transmittance(const ShadePoint& point, float cos_theta);

}  // namespace oriel
