// The lobe that a kernel samples, by itself: what tests hold kernels against.
#pragma once

#include "bake/brdf/quadrature.h"
#include "bake/material/kernel.h"

namespace oriel {

inline LobeOfWidth lobe_of(FacetModel model) {
  return [model](double alpha) { return microfacet_lobe(model, alpha); };
}

// D G2 / (4 cosθo) per unit area of the tangent plane of the mirror direction, at tangents (x, y).
inline double lobe_density(FacetModel model, double alpha, double cos_theta, const DVec2& tangent) {
  const MirrorFrame frame(cos_theta);
  const double length = std::hypot(1, glm::length(tangent));
  const DVec3 wi = (frame.mirror + tangent.x * frame.across + tangent.y * frame.along) / length;
  return microfacet_lobe(model, alpha)(frame.wo, wi, glm::normalize(frame.wo + wi)) / (length * length * length);
}

// The lobe's directional albedo without Fresnel.
inline double lobe_albedo(FacetModel model, double alpha, double cos_theta) {
  double total = 0;
  for_each_reflection(cos_theta, alpha, 24, [&](const DVec3& wi, const DVec3& h, double solid_angle) {
    total += Microfacet(model, alpha).f_cos(direction_at(cos_theta), wi, h) * solid_angle;
  });
  return total;
}

}  // namespace oriel
