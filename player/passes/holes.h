// What of a reflected image nothing was known about.
#pragma once

#include "player/passes/targets.h"
#include "player/reflections/image_target.h"

namespace oriel {

struct HoleCount {
  std::uint64_t pixels = 0, holes = 0;
};

// Over the frame's pixels whose stencil holds `value` in its reflector bits; holes: nothing is known of the image's
// pixel (a = 0) before it is filled from beside. Reads pictures back, which is slow; binds the frame for reading.
HoleCount count_holes(const FrameTarget& frame, GLint value, const ImageTarget& image, const ImageRect& rect);

}  // namespace oriel
