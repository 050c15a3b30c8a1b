// What of a difference between two frames an eye can tell: clouds on a plain wall at once, grain within a carpet
// hardly.
#pragma once

#include "formats/image/flip.h"
#include "formats/image/image.h"

namespace oriel {

struct VisibleError {
  double rms = 0;    // over the pixels: contrast over its threshold, 1 is just noticeable
  double share = 0;  // of the pixels in which it is above 1
  FloatImage map;    // by pixel, one channel
};

// Octaves of spatial frequency; in each the difference's contrast, relative to the reference's mean light around (Peli
// 1990, "Contrast in complex images"), over the faintest that an eye tells (contrast_sensitivity()), raised by what the
// reference shows itself in that octave (masking as Daly 1993, "The visible differences predictor", equation 14.6).
// Linear light, three channels, of one size; `white` is what a display of 100 cd/m² and 1 % of glare shows as white:
// more is cut off.
VisibleError visible_error(const FloatImage& reference, const FloatImage& test, float white,
                           double pixels_per_degree = kPixelsPerDegree);

}  // namespace oriel
