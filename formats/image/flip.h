// FLIP: the difference that a viewer sees who flips between two pictures (Andersson, Nilsson, Akenine-Möller,
// Oskarsson, Åström and Fairchild 2020, "FLIP: A Difference Evaluator for Alternating Images"), for displays of low
// dynamic range.
#pragma once

#include "formats/image/image.h"

namespace oriel {

// 0.7 m before a display of 3840 pixels on 0.7 m, as in the paper.
inline constexpr double kPixelsPerDegree = 67.0206;

// By pixel, one channel, [0, 1] with 0 for equal pictures; the mean is the picture's FLIP. Both: one size, three
// channels, sRGB-encoded in [0, 1].
FloatImage flip_map(const FloatImage& reference, const FloatImage& test, double pixels_per_degree = kPixelsPerDegree);

}  // namespace oriel
