#include "study/bastos1999/pixel_kernel.h"

#include <algorithm>
#include <cmath>

namespace oriel::study {
namespace {

constexpr int kRadius = 5, kMostReduction = 32;

// Beside the middle pixel, which takes half a pixel on each side.
double pixels_beside(const BrdfKernel& kernel, double pixels_per_tangent) {
  constexpr double kNothing = 1e-4;  // so much of a pixel is rounding
  return kernel.size > 1 ? std::max(double{kernel.half_extent} * pixels_per_tangent - 0.5 - kNothing, 0.0) : 0.0;
}

}  // namespace

PixelKernel make_pixel_kernel(const BrdfKernel& kernel, float pixels_per_tangent) {
  PixelKernel out;
  out.radius = static_cast<int>(std::min(std::ceil(pixels_beside(kernel, pixels_per_tangent)), 1.0 * kMostRadius));
  if (out.radius == 0) return out;
  const auto side = static_cast<std::size_t>(2 * out.radius + 1);
  const double cell = 2.0 * kernel.half_extent * pixels_per_tangent / kernel.size;  // pixels
  // Of cell a's width, the share in pixel i, and all of them.
  std::vector<double> shares(side * kernel.size);
  for (std::size_t i = 0; i < side; ++i)
    for (std::size_t a = 0; a < kernel.size; ++a) {
      const double low = (static_cast<double>(a) - 0.5 * kernel.size) * cell;
      const double left = static_cast<double>(i) - out.radius - 0.5;
      shares[i * kernel.size + a] = std::max(std::min(low + cell, left + 1) - std::max(low, left), 0.0) / cell;
    }
  std::vector<double> weights(side * side);
  double sum = 0;
  for (std::size_t j = 0; j < side; ++j)
    for (std::size_t b = 0; b < kernel.size; ++b) {
      const double row = shares[j * kernel.size + b];
      if (row <= 0) continue;
      for (std::size_t i = 0; i < side; ++i)
        for (std::size_t a = 0; a < kernel.size; ++a)
          weights[j * side + i] += row * shares[i * kernel.size + a] * double{kernel.weights[b * kernel.size + a]};
    }
  for (const double w : weights) sum += w;
  out.weights.assign(weights.begin(), weights.end());
  for (float& w : out.weights) w = static_cast<float>(w / sum);
  return out;
}

int choose_reduction(const BrdfKernel& kernel, float pixels_per_tangent) {
  int reduction = 1;
  while (reduction < kMostReduction && pixels_beside(kernel, double{pixels_per_tangent} / reduction) > kRadius)
    reduction *= 2;
  return reduction;
}

}  // namespace oriel::study
