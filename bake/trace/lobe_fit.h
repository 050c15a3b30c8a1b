// Linearly transformed cosines fitted to reflection lobes.
#pragma once

#include "bake/brdf/compensation.h"
#include "formats/assets/brdf_kernel.h"

namespace oriel {

// The best fit to a lobe (BRDF times cosine without Fresnel) seen at cos_theta: least L1 distance of the two,
// normalised, over the directions above the surface, by Nelder and Mead's simplex (1965) from the lobe that slopes of
// half vectors give. alpha: the width of their distribution, [1e-5, 1]; cos_theta: [1e-3, 1].
// The same arguments give the same fit.
LobeFit fit_lobe(const LobeFunction& lobe, double alpha, double cos_theta);

// That distance, [0, 2]: no integral over a region is off by more than it, as a share of the lobe. GGX: below 0.06 up
// to 45° of incidence; Beckmann: about 0.35, whose tails a cosine has not.
double fit_distance(const LobeFunction& lobe, double alpha, double cos_theta, const LobeFit& fit);

}  // namespace oriel
