#include "formats/image/filter.h"

#include <algorithm>
#include <cmath>

namespace oriel {
namespace {

// Along rows, with the result turned on its side: twice gives both directions.
Plane filtered_and_transposed(const Plane& plane, const std::vector<double>& kernel) {
  const int radius = static_cast<int>(kernel.size() / 2);
  Plane out{plane.height, plane.width, std::vector<float>(plane.values.size())};
  std::vector<float> row(static_cast<std::size_t>(plane.width + 2 * radius));
  for (int y = 0; y < plane.height; ++y) {
    for (int x = -radius; x < plane.width + radius; ++x)
      row[static_cast<std::size_t>(x + radius)] =
          plane.values[static_cast<std::size_t>(y * plane.width + std::clamp(x, 0, plane.width - 1))];
    for (int x = 0; x < plane.width; ++x) {
      double sum = 0;
      for (std::size_t k = 0; k < kernel.size(); ++k) sum += kernel[k] * row[static_cast<std::size_t>(x) + k];
      out.values[static_cast<std::size_t>(x * plane.height + y)] = static_cast<float>(sum);
    }
  }
  return out;
}

}  // namespace

Plane filtered(const Plane& plane, const std::vector<double>& along, const std::vector<double>& down) {
  return filtered_and_transposed(filtered_and_transposed(plane, along), down);
}

std::vector<double> gaussian(double sigma, int radius) {
  std::vector<double> out;
  double sum = 0;
  for (int x = -radius; x <= radius; ++x) {
    out.push_back(std::exp(-0.5 * x * x / (sigma * sigma)));
    sum += out.back();
  }
  for (double& v : out) v /= sum;
  return out;
}

}  // namespace oriel
