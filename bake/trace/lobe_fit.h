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

}  // namespace oriel
