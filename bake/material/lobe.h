// The lobes that K is sampled from: microfacet distributions with their shadowing.
#pragma once

#include "bake/trace/brdf/compensation.h"
#include "formats/assets/brdf_kernel.h"

namespace oriel {

// What of the lobe a kernel holds. Divided by 4 cosθo, D G is the whole lobe (BRDF times cosθi) without Fresnel.
enum class LobeForm {
  kD,     // the distribution alone
  kDg,    // times the V-cavities' G (Cook and Torrance 1981), as in Bastos et al. 1999, eq. (4)
  kLobe,  // times the height-correlated G2 of Smith (Heitz 2014): what a path tracer sees
};

// A kernel's distribution. alpha: (0, 1].
Microfacet microfacet(KernelModel model, double alpha);
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

}  // namespace oriel
