#include "formats/image/ssim.h"

#include "formats/core/color.h"
#include "formats/image/filter.h"

namespace oriel {
namespace {

Plane luma(const FloatImage& image) {
  Plane plane{static_cast<int>(image.width), static_cast<int>(image.height), {}};
  for (std::size_t i = 0; i < image.pixels.size(); i += 3)
    plane.values.push_back(luminance(Vec3(image.pixels[i], image.pixels[i + 1], image.pixels[i + 2])));
  return plane;
}

Plane product(const Plane& a, const Plane& b) {
  Plane out = a;
  for (std::size_t i = 0; i < out.values.size(); ++i) out.values[i] *= b.values[i];
  return out;
}

}  // namespace

FloatImage ssim_map(const FloatImage& a, const FloatImage& b) {
  constexpr double kC1 = 0.01 * 0.01, kC2 = 0.03 * 0.03;
  const std::vector<double> window = gaussian(1.5, 5);
  const Plane x = luma(a), y = luma(b);
  const auto mean = [&](const Plane& plane) { return filtered(plane, window, window).values; };
  const auto mx = mean(x), my = mean(y), xx = mean(product(x, x)), yy = mean(product(y, y)), xy = mean(product(x, y));
  FloatImage out{a.width, a.height, 1, std::vector<float>(mx.size())};
  for (std::size_t i = 0; i < mx.size(); ++i) {
    const double mean_x = mx[i], mean_y = my[i];
    const double variances = xx[i] - mean_x * mean_x + yy[i] - mean_y * mean_y, covariance = xy[i] - mean_x * mean_y;
    out.pixels[i] = static_cast<float>((2 * mean_x * mean_y + kC1) * (2 * covariance + kC2) /
                                       ((mean_x * mean_x + mean_y * mean_y + kC1) * (variances + kC2)));
  }
  return out;
}

}  // namespace oriel
