// Frames on screen: what a display shows of linear light, and how far two of those pictures are apart.
#pragma once

#include "formats/metrics/region.h"

namespace oriel {

// The luminance shown as white where the log-average luminance over the lit pixels becomes middle grey, 18 %; 1 where
// no pixel is lit.
float white_of(const FloatImage& light);

// light / white clamped to [0, 1], sRGB-encoded; three channels.
FloatImage shown(const FloatImage& light, float white);

// Peak signal-to-noise ratio of two pictures of values in [0, 1], dB; 99 for equal ones.
double psnr(const FloatImage& a, const FloatImage& b, const Region& region = {});

}  // namespace oriel
