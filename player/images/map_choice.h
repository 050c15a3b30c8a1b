// Which radiance maps an eye uses. Reflector space throughout.
#pragma once

#include <span>
#include <vector>

#include "formats/assets/radiance_map.h"

namespace oriel {

// An element of a reflector and the maps taken through it.
struct ReflectorElement {
  Vec2 lower{0}, upper{0};
  std::vector<std::uint32_t> maps;  // into Pack::radiance_maps
};

// The maps of `reflector` by element, in their order.
std::vector<ReflectorElement> group_by_element(const Reflector& reflector, std::span<const RadianceMap> maps);

// Into ReflectorElement::maps, all, those that suit an eye best first (Bastos et al. 1999, section 8.1.3, "Selection"):
// smallest angle at the element's centre between their eyes and mirrored_eye, which is the eye with z negated (w = 1),
// or the direction to it (w = 0). Ties go to the first.
std::vector<std::uint32_t> maps_by_angle(const ReflectorElement& element, std::span<const RadianceMap> maps,
                                         const Vec4& mirrored_eye);

}  // namespace oriel
