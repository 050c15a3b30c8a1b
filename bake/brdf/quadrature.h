// Integrals over the hemisphere of directions that a lobe reflects to, to 1e-4 and better for lobes of any width.
#pragma once

#include <vector>

#include "formats/core/vec.h"

namespace oriel {

// Nodes and weights of Gauss and Legendre's rule on [0,1].
struct GaussRule {
  std::vector<double> nodes, weights;
};
// order in [1, 512]. Kept once made.
const GaussRule& gauss_rule(int order);

// wo of cosine cos_theta in the plane y = 0.
inline DVec3 direction_at(double cos_theta) {
  return {std::sqrt(std::max(0.0, (1 - cos_theta) * (1 + cos_theta))), 0, cos_theta};
}

// Calls visit(wi, h, solid_angle) for the nodes of a rule over all wi above the horizon with wi.y >= 0 (the other half
// is its mirror image, its solid angle is counted in), so that ∫ g(wi) dωi = Σ g(wi) · solid_angle for a g that is
// symmetric in y. The nodes are half vectors: in polar coordinates of their slope (r, φ) around the normal, with
// r = width · tanψ, so that a lobe as wide in slope as `width` is smooth in (ψ, φ) however narrow it is. The slopes
// whose reflection is above the horizon fill a disk of centre -tanθ and radius 1 / cosθ: r ends at its rim.
template <class Visit>
void for_each_reflection(double cos_theta, double width, int order, const Visit& visit) {
  const GaussRule& rule = gauss_rule(order);
  const DVec3 wo = direction_at(cos_theta);
  const double tan_theta = wo.x / wo.z;
  for (int side = 0; side < 2; ++side)  // φ in [0, π/2] and [π/2, π]: grazing lobes have a kink between them
    for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
      const double phi = kPiD / 2 * rule.nodes[j], cosine = (side == 0 ? 1 : -1) * std::cos(phi), sine = std::sin(phi);
      const double b = tan_theta * cosine, root = std::sqrt(b * b + 1);
      const double rim = b > 0 ? 1 / (b + root) : root - b;
      const double last = std::atan(rim / width);
      for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        const double left = 1 - rule.nodes[i];  // squared: denser at the rim, where grazing shadowing sets in
        const double psi = last * (1 - left * left), t = std::tan(psi), r = width * t;
        const double cos_h = 1 / std::sqrt(1 + r * r);
        const DVec3 h(-r * cosine * cos_h, -r * sine * cos_h, cos_h);
        const double visible = 1 - r * b;  // wo·h / (cosθ cos_h)
        const double cos_d = wo.z * visible * cos_h;
        DVec3 wi = 2 * cos_d * h - wo;
        wi.y = -wi.y;
        wi.z = wo.z * (1 - r * r - 2 * r * b) * cos_h * cos_h;  // without the difference of nearly equal numbers
        // dωi = 4 wo·h dωh, dωh = cos³ r dr dφ, dr = width (1 + t²) dψ; twice for the mirror image
        const double area = r * width * (1 + t * t) * last * 2 * left * rule.weights[i] * kPiD / 2 * rule.weights[j];
        visit(wi, DVec3(h.x, -h.y, h.z), 2 * 4 * cos_d * cos_h * cos_h * cos_h * area);
      }
    }
}

}  // namespace oriel
