// Microfacet distributions with Smith's shadowing, and the sampling of visible normals. Local space: z along the
// surface's normal; wo, wi and h are unit vectors, wo.z > 0. In double: finite and right to 1e-9 for alpha and cosines
// from 1e-4 to 1.
#pragma once

#include "formats/core/vec.h"

namespace oriel {

enum class FacetModel : std::uint8_t { kGgx, kBeckmann };

// alpha_x, alpha_y: width along x and y, root mean square slope · √2 for Beckmann; (0, 1].
struct Microfacet {
  FacetModel model = FacetModel::kGgx;
  double alpha_x = 1, alpha_y = 1;

  Microfacet(FacetModel m, double alpha) : Microfacet(m, alpha, alpha) {}
  Microfacet(FacetModel m, double ax, double ay) : model(m), alpha_x(ax), alpha_y(ay) {}

  // Density of normals per steradian: ∫ D cosθ dω = 1 (Walter et al. 2007; Trowbridge and Reitz 1975). 0 below z = 0.
  double d(const DVec3& h) const;
  // Smith's Λ: exact for both models.
  double lambda(const DVec3& v) const;
  double g1(const DVec3& v) const { return 1 / (1 + lambda(v)); }
  // Height-correlated masking and shadowing (Heitz 2014): 1 / (1 + Λ(wo) + Λ(wi)).
  double g2(const DVec3& wo, const DVec3& wi) const { return 1 / (1 + lambda(wo) + lambda(wi)); }

  // D G2 / (4 cosθo): the BRDF times cosθi without Fresnel's factor, for the half vector h. 0 where wi.z <= 0.
  double f_cos(const DVec3& wo, const DVec3& wi, const DVec3& h) const;

  // A normal h in proportion to what wo sees of it, u in [0,1)²: GGX after Dupuy and Benyoub 2023 (spherical caps),
  // Beckmann after Heitz and d'Eon 2014 (slopes).
  DVec3 sample_visible_normal(const DVec3& wo, const DVec2& u) const;
  // Its density per steradian of the direction that h reflects wo to: D G1(wo) / (4 cosθo).
  double reflected_pdf(const DVec3& wo, const DVec3& h) const { return d(h) * g1(wo) / (4 * wo.z); }
};

// w mirrored at h.
inline DVec3 reflect_at(const DVec3& w, const DVec3& h) {
  return 2 * glm::dot(w, h) * h - w;
}

}  // namespace oriel
