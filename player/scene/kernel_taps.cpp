#include "player/scene/kernel_taps.h"

#include <algorithm>
#include <span>

namespace oriel {
namespace {

// Position in [0, n] where the running sum of weights reaches u * total; linear inside a cell.
double invert(std::span<const double> weights, double u) {
  double total = 0;
  for (const double w : weights) total += w;
  double left = u * total;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (left < weights[i]) return static_cast<double>(i) + left / weights[i];
    left -= weights[i];
  }
  return static_cast<double>(weights.size());
}

double radical_inverse_2(std::uint32_t i) {
  double value = 0, digit = 0.5;
  for (; i != 0; i >>= 1, digit *= 0.5) value += (i & 1) * digit;
  return value;
}

}  // namespace

KernelTaps make_kernel_taps(const BrdfKernel& kernel, int count) {
  KernelTaps out;
  const std::size_t n = kernel.size;
  if (n <= 1 || !(kernel.half_extent > 0) || count <= 1) {
    out.taps.push_back({});
    return out;
  }
  std::vector<double> rows(n, 0.0), row(n);
  for (std::size_t y = 0; y < n; ++y) {
    for (std::size_t x = 0; x < n; ++x) rows[y] += kernel.weights[y * n + x];
  }
  const double cell = 2.0 * kernel.half_extent / static_cast<double>(n);
  std::vector<double> radii;
  for (int i = 0; i < count; ++i) {
    const double v = invert(rows, (i + 0.5) / count);
    const std::size_t y = std::min(static_cast<std::size_t>(v), n - 1);
    for (std::size_t x = 0; x < n; ++x) row[x] = kernel.weights[y * n + x];
    const double u = invert(row, radical_inverse_2(static_cast<std::uint32_t>(i)) + 0.5 / count);
    const std::size_t x = std::min(static_cast<std::size_t>(u), n - 1);
    const double weight = std::max(static_cast<double>(kernel.weights[y * n + x]), 1e-12);
    KernelTap tap;
    tap.tangent = Vec2(DVec2(u, v) * cell - DVec2(kernel.half_extent));
    tap.width = static_cast<float>(std::min(cell / std::sqrt(weight * count), 2.0 * kernel.half_extent));
    out.taps.push_back(tap);
    radii.push_back(glm::length(DVec2(tap.tangent)));
  }
  std::sort(radii.begin(), radii.end());
  out.median = static_cast<float>(radii[radii.size() / 2]);
  return out;
}

}  // namespace oriel
