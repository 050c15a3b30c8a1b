// R: directional reflectance as the tables that modulate a reflected image (Bastos et al. 1999, section 8.2.2).
#pragma once

#include "formats/assets/fresnel_map.h"

namespace oriel {

// The directional albedo of the GGX lobe of width alpha with Schlick's Fresnel from f0 (per channel) to f90, [0, 1].
// table_size entries, at least 2, at cosθ = (i / (n-1))²; sphere_size² texels (0: no sphere map). Arguments are clamped
// to [0, 1], NaN to 0.
FresnelMap make_fresnel_map(const Vec3& f0, float f90, float alpha, std::uint32_t table_size = 64,
                            std::uint32_t sphere_size = 64);

// How a sphere map is addressed: the incidence cosθ held at distance r in [0, 1] from its centre, equal area:
// r = √2 sin(θ/2), so cosθ = 1 - r². r > 1 counts as 1.
float sphere_map_cos_theta(float r);

// R at cosθ from a map's table, linear in √cosθ, as the player reads it.
Vec3 fresnel_lookup(const FresnelMap& map, float cos_theta);

}  // namespace oriel
