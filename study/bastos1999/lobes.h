// The lobes that the paper's kernels are sampled from: a distribution of facets with the shadowing of Cook and
// Torrance.
#pragma once

#include "bake/material/kernel.h"
#include "bake/material/reflectance.h"

namespace oriel::study {

enum class Facets { kBeckmann, kGaussian };

// Density per steradian of half vectors at cosθ from the normal by Cook and Torrance's Gaussian of angles, exp -(θ/α)²,
// over πα²: that its integral times cosθ is 1 holds for small α only, which a kernel's sum of 1 does not need.
double gaussian_d(double cos_theta, double alpha);
// G of the V-shaped grooves of Cook and Torrance 1982: it knows no width.
double v_cavity_g(const DVec3& wo, const DVec3& wi, const DVec3& h);
// D(h) G / (4 cosθo), 0 below the horizon: the BRDF times cosθi without Fresnel's factor, equation (4).
LobeFunction cook_torrance_lobe(Facets facets, double alpha);

// π F / (π N·L N·V), F over the denominator of equation (4) times k_s = π, so that a mirror seen straight reflects F;
// at most 1, as in a texture. L is the mirror direction of V, so both cosines are θ's.
Vec3 equation_4(const SpecularLayers& layers, double cos_theta);

// R over the hemisphere of reflected vectors: side² texels, texel (x, y) at the point ((x+½), (y+½)) / side * 2 - 1 of
// the square, a disk of radius 1 inside it. The centre is the surface's normal, the rim grazing: the reflected vector
// (sinθ cosφ, sinθ sinφ, cosθ) in the surface's frame lies at √2 sin(θ/2) (cosφ, sinφ), an equal-area map, so cosθ =
// 1 - r². Texels outside the disk hold the rim's value.
struct SphereMap {
  std::uint32_t side = 0;
  std::vector<Vec3> texels;
};
SphereMap make_sphere_map(std::uint32_t side, const std::function<Vec3(double cos_theta)>& reflectance);
// Bilinear as it is drawn, along the x axis of the map. 0 where there is none.
Vec3 sphere_lookup(const SphereMap& map, float cos_theta);
// cosθ at distance r from its centre; r beyond the rim counts as 1.
float sphere_map_cos_theta(float r);

}  // namespace oriel::study
