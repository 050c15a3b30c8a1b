// The lobes that K is sampled from: microfacet distributions with their shadowing.
#pragma once

#include <vector>

#include "bake/brdf/compensation.h"
#include "bake/brdf/microfacet.h"
#include "formats/assets/brdf_kernel.h"

namespace oriel {

// Microfacet::f_cos of facets of that width: what a path tracer sees.
LobeFunction microfacet_lobe(FacetModel model, double alpha);

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
