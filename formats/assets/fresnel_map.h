// R: how much a material reflects by direction (Bastos et al. 1999, section 8.2.2).
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "formats/core/vec.h"

namespace oriel {

// Directional albedo of the specular lobe with Fresnel, per channel, in [0,1].
struct FresnelMap {
  float alpha = 0;
  // Entry i of n is at cosθ = (i / (n-1))², so that grazing angles get the most entries.
  std::vector<Vec3> table;
  // F of the lobe's facets alone, [0,1]; entry i of n where the half vector is at cosθ = (i / (n-1))² from the eye. R
  // says how much of the light comes back, this what directions it comes from. Empty: from all alike.
  std::vector<Vec3> factor;
};

// Linear between the entries of a table whose entry i of n is at cosθ = (i / (n-1))². The cosine is clamped to [0,1],
// NaN counts as 0; 0 for an empty table.
inline Vec3 lookup_by_cosine(std::span<const Vec3> table, float cos_theta) {
  if (table.empty()) return Vec3(0);
  const auto last = table.size() - 1;
  const float at = std::sqrt(cos_theta > 0 ? std::min(cos_theta, 1.0f) : 0.0f) * static_cast<float>(last);
  const auto i = std::min(static_cast<std::size_t>(at), last);
  return glm::mix(table[i], table[std::min(i + 1, last)], at - static_cast<float>(i));
}

}  // namespace oriel
