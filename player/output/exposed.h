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

// What the camera shows from a place of its lens, metres to the right and up: things at focus_m along the view (> 0)
// stay where they are in the picture. pixel: by how much of a pixel it is moved. Orthographic cameras have no lens.
View lens_view(const Camera& camera, const IVec2& size, const Bounds& bounds, const Vec2& place_m, float focus_m,
               const Vec2& pixel);

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
