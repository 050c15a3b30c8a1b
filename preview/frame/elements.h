// Reflected light as lights: where light lands, elements of surfaces shine back (Udeshi & Hansen 1999, section 3, for
// one bounce; here particles go on).
#pragma once

#include <span>

#include "preview/frame/landings.h"

namespace oriel {

// A disk that reflects diffusely.
struct BounceElement {
  Vec3 place{0}, normal{0, 0, 1};
  float area = 0;              // m²
  Vec3 power{0};               // radiance times area: what leaves along the normal, cd
  std::vector<Vec3> places{};  // on it, a little before the surface: rays that look for shadows go there
};

// At most `count` elements that reflect diffusely what comes to surfaces: landings of the lamps' particles, brought
// together by place and normal until so few are left. No light is lost by that. The brightest come first.
std::vector<BounceElement> bounce_elements(std::span<const Landing> landings, const Scene& scene, std::uint32_t count);

// At most so many of them by power, each as bright as those that it stands for; on the mean over u in [0,1) all.
std::vector<BounceElement> some_of(std::span<const BounceElement> elements, std::size_t count, float u);

}  // namespace oriel
