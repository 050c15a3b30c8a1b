// R: how much a material reflects by direction (Bastos et al. 1999, section 8.2.2).
#pragma once

#include <vector>

#include "formats/core/vec.h"

namespace oriel {

// Directional albedo of the specular lobe with Fresnel, per channel, in [0,1].
struct FresnelMap {
  float alpha = 0;
  // Entry i of n is at cosθ = (i / (n-1))², so that grazing angles get the most entries.
  std::vector<Vec3> table;
  // The paper's sphere map: a disk in a square of sphere_size² texels; radius r in [0,1] from the centre holds
  // the incidence of a sphere's normal there, sin(θ) = sin of the angle of the reflected vector = see docs/format.md.
  std::uint32_t sphere_size = 0;
  std::vector<Vec3> sphere;
};

}  // namespace oriel
