// One bounce as lights: where lamps shine, elements of surfaces shine back (Udeshi & Hansen 1999, section 3).
#pragma once

#include "bake/jobs/context.h"
#include "bake/trace/path.h"

namespace oriel {

// A disk that reflects diffusely.
struct BounceElement {
  Vec3 place{0}, normal{0, 0, 1};
  float area = 0;  // m²
  Vec3 power{0};   // radiance times area: what leaves along the normal, cd
};

// At most `count` elements that reflect what all lamps throw on surfaces: particles of the lamps where they land first,
// brought together by place and normal until so few are left. No light is lost by that. The brightest come first.
std::vector<BounceElement> bounce_elements(const Transport& transport, std::uint64_t seed, std::uint32_t count);

}  // namespace oriel
