// Where light comes from: its first moment over the sphere, beside its mean (LightmapPage::direction).
#pragma once

#include <algorithm>

#include "formats/core/vec.h"

namespace oriel {

// Light of that luminance times solid angle (cd/m² sr) from one direction, over the sphere: vector (xyz), mean (w).
inline Vec4 moments_of(float light, const Vec3& direction) {
  const float share = light / (4 * kPi);
  return {share * direction, share};
}

// The direction d = vector / mean, |d| <= 1.
inline Vec3 direction_of(const Vec4& moments) {
  if (!(moments.w > 0)) return Vec3(0);
  const Vec3 d = Vec3(moments) / moments.w;
  return d / std::max(1.0f, glm::length(d));  // longer than 1 by rounding only
}

// Cosine rays weight light by 1 / cosine: grazing ones are held to this cosine, lest a few decide the direction.
inline constexpr float kLeastCosine = 0.05f;

}  // namespace oriel
