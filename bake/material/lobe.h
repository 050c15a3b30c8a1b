// The lobes that K is sampled from: microfacet distributions with their shadowing.
#pragma once

#include <functional>

#include "formats/assets/brdf_kernel.h"

namespace oriel {

// What of the lobe a kernel holds. Divided by 4 cosθo, D G is the whole lobe (BRDF times cosθi) without Fresnel.
enum class LobeForm {
  kD,     // the distribution alone
  kDg,    // times the V-cavities' G (Cook and Torrance 1981), as in Bastos et al. 1999, eq. (4)
  kLobe,  // times the height-correlated G2 of Smith (Heitz 2014): what a path tracer sees
};

// A lobe's density per solid angle at unit directions over a surface with normal +z: wo to the eye, wi to the light, h
// between them; 0 where wi.z <= 0.
using LobeFunction = std::function<double(const DVec3& wo, const DVec3& wi, const DVec3& h)>;

// D(h) G / (4 cosθo) of a lobe of width alpha > 0. Forms that hold for alpha from 1e-5 up: D is taken from tan²θh.
LobeFunction microfacet_lobe(KernelModel model, LobeForm form, double alpha);

// Smith's Λ at cos_v > 0: G1 = 1 / (1 + Λ), G2 = 1 / (1 + Λ(wo) + Λ(wi)).
double smith_lambda(KernelModel model, double alpha, double cos_v);

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
