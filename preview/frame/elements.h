// Reflected light as lights: where light lands, elements of surfaces shine back (Udeshi & Hansen 1999, section 3, for
// one bounce; here particles go on).
#pragma once

#include <span>

#include "preview/frame/lamps.h"
#include "preview/frame/landings.h"

namespace oriel {

// A piece of surfaces that reflects diffusely, all of whose light may be taken to come from any one of its places: by
// them its light has its directions and shadows, on the mean.
struct BounceElement {
  struct Place {
    Vec3 place{0}, normal{0, 0, 1};  // a little before the surface
    Vec3 power{0};                   // of all of the element, as it is if taken to be here
  };
  float area = 0;               // m²
  Vec3 power{0};                // radiance times area: what leaves along the normal, cd
  std::vector<Place> places{};  // by power
  double importance = 0;        // in proportion to how often it is to be taken
};

// All of an element as a lamp at one of its places; soft: LampPoint's.
LampPoint lamp_at(const BounceElement::Place& place, float soft);

// At most `count` elements (or as many as normals have axes) that reflect diffusely what comes to surfaces: landings of
// the lamps' particles, brought together by normal and place, finer where they shine more on the eye's points. No light
// is lost by that. Error kStopped.
Result<std::vector<BounceElement>> bounce_elements(std::span<const Landing> landings, std::span<const EyePoint> eye,
                                                   std::uint32_t count, const Accel& accel, Context& context);

// importance: what they shine on the eye's points past what is between. A tenth more is shared by what they shine else,
// and a hundredth by power, so that those whose light other pixels get are taken too. Error kStopped.
Status find_importance(std::vector<BounceElement>& elements, std::span<const EyePoint> eye, const Accel& accel,
                       Context& context);

// At most so many of them by importance, each as bright as those that it stands for; on the mean over u in [0,1) all.
std::vector<BounceElement> some_of(std::span<const BounceElement> elements, std::size_t count, float u);

}  // namespace oriel
