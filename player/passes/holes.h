// What of a reflected image nothing was known about, or only coarsely.
#pragma once

#include "player/passes/targets.h"
#include "player/reflections/image_target.h"

namespace oriel {

struct PixelCount {
  std::uint64_t pixels = 0, counted = 0;
};

// Over the frame's pixels whose stencil holds `value` in its reflector bits: those where `counts` holds of the image's
// pixel, before its holes are filled. Reads pictures back, which is slow; binds the frame for reading.
PixelCount count_pixels(const FrameTarget& frame, GLint value, const ImageTarget& image, const ImageRect& rect,
                        bool (*counts)(const Vec4&));

// Nothing is known: filled from beside, it may be wrong.
inline bool is_hole(const Vec4& light) {
  return light.a == 0;
}
// Of a measured image (MarchPass): a map pixel covers no more than two of the image's, as maps are planned for.
inline bool is_sharp(const Vec4& measured) {
  return measured.a > 0 && measured.r <= 2;
}

}  // namespace oriel
