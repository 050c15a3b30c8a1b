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

struct WeighedMap {
  std::uint32_t map = 0;  // into ReflectorElement::maps
  float weight = 0;
};

// All maps of the element, those that suit an eye best first (Bastos et al. 1999, section 8.1.3, "Selection"): smallest
// angle at the element's centre between their eyes and mirrored_eye, which is the eye with z negated (w = 1), or the
// direction to it (w = 0). Ties go to the first. The first `count` have weights, sum 1, that fall to 0 at the next
// one's cost (Buehler et al. 2001, "Unstructured Lumigraph Rendering", section 5.1), times their resolution over the
// finest: a moving eye changes maps without a jump.
std::vector<WeighedMap> weigh_maps(const ReflectorElement& element, std::span<const RadianceMap> maps,
                                   const Vec4& mirrored_eye, int count);

}  // namespace oriel
