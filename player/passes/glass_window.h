// Through which face of a body of glass the eye looks, and from where what lies beyond it is seen as the refracted rays
// see it: the apparent eye over a water surface.
#pragma once

#include <optional>

#include "player/navigation/view.h"
#include "player/scene/glass_bodies.h"

namespace oriel {

struct GlassWindow {
  View view;     // from the apparent eye, of what rays that are refracted at the face meet as they leave the body
  Mat4 clip{1};  // its clip space, without what lies before the face
};

// Of the face that most is seen of. None where the body is curved, where the eye is within it or infinitely far, where
// the glass bends less than `least_pixels` or nothing of it is in view. ior: at least 1.
std::optional<GlassWindow> window_of(const GlassBody& body, float ior, float least_pixels, const View& view,
                                     const Bounds& scene);

}  // namespace oriel
