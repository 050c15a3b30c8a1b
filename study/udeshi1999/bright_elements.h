// One bounce of light: the pieces of surfaces that reflect most, as lamps (Udeshi & Hansen 1999, section 3).
#pragma once

#include "preview/frame/preview_scene.h"

namespace oriel::study {

// At most `count` of elements of about equal area, those that reflect most of what the lamps' points shine on their
// middles. They shine for the others too: their power is that of all elements. Error kStopped.
Result<std::vector<LampPoint>> bright_elements(const PreviewScene& scene, std::span<const LampPoint> lamps,
                                               std::size_t count, Context& context);

}  // namespace oriel::study
