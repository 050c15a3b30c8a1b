// Frames on screen: what a display shows of linear light, and how far two of those pictures are apart.
#pragma once

#include "formats/image/region.h"

namespace oriel {

// The luminance shown as white where the log-average luminance over the lit pixels becomes middle grey, 18 %; 1 where
// no pixel is lit.
float white_of(const FloatImage& light);

// light / white clamped to [0, 1], sRGB-encoded; three channels.
FloatImage shown(const FloatImage& light, float white);

// The variance of that by value where light has this standard error: half of the distance between light + and - noise.
FloatImage shown_variance(const FloatImage& light, const FloatImage& noise, float white);

// Squared difference by value of pictures of one shape.
FloatImage squared_difference(const FloatImage& a, const FloatImage& b);

// Peak signal-to-noise ratio of values in [0, 1] with that mean squared difference, dB; 99 at most.
double psnr_db(double mean_squared_difference);

}  // namespace oriel
