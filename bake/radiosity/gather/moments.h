// The first moment of light over the sphere, and its mean, for LightmapPage::direction.
#pragma once

#include <algorithm>

#include "formats/core/vec.h"

namespace oriel {

// First moment (xyz) and mean (w) over the sphere of light from one direction. light: luminance times solid angle,
// cd/m² sr. direction: unit.
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

// The moments weight cosine-distributed rays by 1 / cosine. The cosine is clamped to at least this, so that a few
// grazing rays do not decide the direction.
inline constexpr float kLeastCosine = 0.05f;

}  // namespace oriel
