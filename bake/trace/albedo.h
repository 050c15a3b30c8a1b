// Directional albedo of the specular lobe, the split-sum form (Karis 2013): R(θ) = f0 * scale + f90 * bias.
#pragma once

#include "bake/scene/shade.h"

namespace oriel {

// {scale, bias} of a GGX lobe of width alpha with height-correlated Smith and Schlick's Fresnel, single scattering.
// cos_theta and alpha in [0,1]. From a table computed once by quadrature; absolute error below 2e-3. scale + bias <= 1.
Vec2 specular_albedo(float cos_theta, float alpha);

// R of a shading point per channel, [0,1].
Vec3 reflectance(const ShadePoint& point, float cos_theta);

// Share of light that passes straight through a surface at that incidence: what coverage leaves open, and thin
// transmission after Fresnel.
Vec3 straight_transmittance(const ShadePoint& point, float cos_theta);

}  // namespace oriel
