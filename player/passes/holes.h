// What of a reflected image nothing was known about: filled from beside, it may be wrong.
#pragma once

#include "player/passes/targets.h"
#include "player/reflections/image_target.h"

namespace oriel {

struct HoleCount {
  std::uint64_t pixels = 0, holes = 0;
};

// Over the frame's pixels whose stencil holds `value` in its reflector bits, before the image's holes are filled. Reads
// pictures back, which is slow; binds the frame for reading.
HoleCount count_holes(const FrameTarget& frame, GLint value, const ImageTarget& image, const ImageRect& rect);

}  // namespace oriel
