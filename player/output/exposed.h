// A picture as the mean of frames: antialiased, out of focus, blurred by motion (Haeberli & Akeley 1990, "The
// Accumulation Buffer").
#pragma once

#include "formats/image/image.h"
#include "player/navigation/view.h"
#include "player/session/lens_options.h"

namespace oriel {

// Where in a pixel, on the lens and in the time that it is open a frame is taken.
struct ExposurePoint {
  Vec2 pixel{0};   // [-½, ½)², pixels
  Vec2 lens{0};    // in the unit disk
  float time = 0;  // [-½, ½)
};
// Frame i of n. Even over each of them (Halton's sequence), the first of one alone in the middle.
ExposurePoint exposure_point(std::uint32_t i, std::uint32_t n);

// Where a frame of a lens is taken from.
struct LensPlace {
  Vec2 aside_m{0};    // to the right and up, of the camera's eye
  float focus_m = 1;  // > 0, along the view: things there stay where they are in the picture
  Vec2 pixel{0};      // that the picture is moved by
};
// What the camera shows from there. Orthographic cameras have no lens.
View lens_view(const Camera& camera, const IVec2& size, const Bounds& bounds, const LensPlace& from);

// The mean of frames, RGBA as Renderer::take_light() takes it. What is shown as it is in all of them stays so.
class FrameMean {
 public:
  // Of one size.
  void add(const FloatImage& frame);
  FloatImage mean() const;

 private:
  FloatImage sum_;
  std::vector<double> light_;
  std::uint32_t count_ = 0;
};

}  // namespace oriel
