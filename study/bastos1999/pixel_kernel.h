// K as one kernel of pixels for a whole reflected image (Bastos et al. 1999, section 8.2.1).
#pragma once

#include <vector>

#include "formats/assets/brdf_kernel.h"

namespace oriel::study {

struct PixelKernel {
  int radius = 0;                    // pixels beside the middle one
  std::vector<float> weights{1.0f};  // (2 radius + 1)², sum 1; row by row as BrdfKernel::weights
};

// The centred kernel in an image of so many pixels a tangent: a pixel's weight is the kernel's integral over it, its
// weights being even over their own pixels. Nothing is cut off below kMostRadius.
inline constexpr int kMostRadius = 31;
PixelKernel make_pixel_kernel(const BrdfKernel& kernel, float pixels_per_tangent);

// Pixels of the frame along a side of one of the image in which the kernel has no more than five pixels beside its
// middle: a power of two, 1 to 32. pixels_per_tangent: of the frame.
int choose_reduction(const BrdfKernel& kernel, float pixels_per_tangent);

}  // namespace oriel::study
