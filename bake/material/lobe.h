// The lobes that K is sampled from: microfacet distributions with their shadowing.
#pragma once

#include <vector>

#include "bake/brdf/compensation.h"
#include "formats/assets/brdf_kernel.h"

namespace oriel {

// Which shadowing a lobe has. Divided by 4 cosθo, D G is the BRDF times cosθi without Fresnel's factor. A Gaussian has
// no Smith's G2: its kLobe is its kDg.
enum class LobeForm {
  kD,     // none: the distribution alone
  kDg,    // the V-cavities' G (Cook and Torrance 1981), as in Bastos et al. 1999, eq. (4)
  kLobe,  // the height-correlated G2 of Smith (Heitz 2014): what a path tracer sees, and packs hold
};

// Density per steradian of half vectors at cosθ from the normal by Cook and Torrance's Gaussian of angles, exp -(θ/α)²,
// over πα²: that its integral times cosθ is 1 holds for small α only, which a kernel's sum of 1 does not need.
double gaussian_d(double cos_theta, double alpha);
// D(h) G / (4 cosθo), 0 below the horizon.
LobeFunction microfacet_lobe(KernelModel model, LobeForm form, double alpha);

// The mirror direction of an eye at cosθ in the plane y = 0, and the axes of its tangent plane.
struct MirrorFrame {
  DVec3 wo, mirror, across, along;  // along: towards the normal as the mirror direction tilts away from it
  explicit MirrorFrame(double cos_theta) {
    const double sin_theta = std::sqrt(std::max(0.0, 1 - cos_theta * cos_theta));
    wo = {sin_theta, 0, cos_theta};
    mirror = {-sin_theta, 0, cos_theta};
    across = {0, 1, 0};
    along = {cos_theta, 0, sin_theta};
  }
};

// The lobe as nodes of a lattice rule over half vectors, their slopes spread as alpha t / (1 - t) for even t:
// directions on the side of `across`, each with the lobe's weight of both sides, which are alike. The weights' sum is
// the lobe's albedo. Rings are skewed by the golden ratio, so that no quantile falls on a step.
struct LobeNode {
  DVec3 wi;
  double weight;
};
std::vector<LobeNode> lobe_nodes(const LobeFunction& lobe, double alpha, const MirrorFrame& frame, int polar,
                                 int azimuth);

}  // namespace oriel
