#include "player/scene/kernel_taps.h"

#include <algorithm>
#include <functional>
#include <span>

#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr int kCentredRows = 9;

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

// Taps of a texture of n² weights. place: from [0, 1]² to mirror coordinates.
std::vector<KernelTap> taps_of(const std::vector<float>& weights, std::size_t n, int count,
                               const std::function<DVec2(const DVec2&)>& place) {
  std::vector<double> rows(n, 0.0), row(n);
  for (std::size_t y = 0; y < n; ++y)
    for (std::size_t x = 0; x < n; ++x) rows[y] += weights[y * n + x];
  const double side = 1.0 / static_cast<double>(n);
  std::vector<KernelTap> taps;
  for (int i = 0; i < count; ++i) {
    const double v = invert(rows, (i + 0.5) / count);
    const std::size_t y = std::min(static_cast<std::size_t>(v), n - 1);
    for (std::size_t x = 0; x < n; ++x) row[x] = weights[y * n + x];
    const double u = invert(row, radical_inverse_2(static_cast<std::uint32_t>(i)) + 0.5 / count);
    const std::size_t x = std::min(static_cast<std::size_t>(u), n - 1);
    // The cell around it, and how many taps share it.
    const DVec2 corner = DVec2(x, y) * side;
    const DVec2 cell = place(corner + side) - place(corner), all = place({1, 1}) - place({0, 0});
    const double sharing = std::max(static_cast<double>(weights[y * n + x]), 1e-12) * count;
    KernelTap tap;
    tap.at = place(DVec2(u, v) * side);
    tap.width = static_cast<float>(std::sqrt(std::min(cell.x * cell.y / sharing, all.x * all.y)));
    taps.push_back(tap);
  }
  return taps;
}

// Of a kernel that does not say how it changes with incidence.
std::vector<KernelTap> centred_taps(const BrdfKernel& kernel, int count, double cos_theta) {
  auto taps = taps_of(kernel.weights, kernel.size, count, [&](const DVec2& at) {
    const DVec2 tangent = (2.0 * at - 1.0) * double{kernel.half_extent} * DVec2(cos_theta, 1);
    return tangent * 2.0 / (1 + std::sqrt(1 + glm::dot(tangent, tangent)));
  });
  return taps;
}

// The lobe's between two slices: points of the same share of the energy, on the line between them.
std::vector<KernelTap> lobe_taps(const std::vector<std::vector<KernelTap>>& slices, const BrdfKernel& kernel,
                                 double root) {
  const SlicePosition at = find_slice(kernel, root * root);
  std::vector<KernelTap> taps = slices[at.below];
  for (std::size_t k = 0; k < taps.size(); ++k) {
    const KernelTap& next = slices[at.above][k];
    taps[k].at = glm::mix(taps[k].at, next.at, at.share);
    taps[k].width = glm::mix(taps[k].width, next.width, at.share);
  }
  return taps;
}

// The half vector's cosine to the eye of a lobe's direction u at an incidence, and the direction's to the normal.
struct TapCosines {
  double half, normal;
};
TapCosines tap_cosines(const DVec2& u, double cos_theta) {
  // The mirror direction is z, and the normal leans from it towards y.
  const double q = 0.25 * glm::dot(u, u), sin_theta = std::sqrt(std::max(0.0, 1 - cos_theta * cos_theta));
  const DVec3 normal(0, sin_theta, cos_theta), w = DVec3(u.x, u.y, 1 - q) / (1 + q);
  const DVec3 eye = 2 * cos_theta * normal - DVec3(0, 0, 1);
  return {std::sqrt(std::max(0.0, 0.5 * (1 + glm::dot(eye, w)))), glm::dot(normal, w)};
}

float median_radius(std::span<const KernelTap> taps) {
  std::vector<float> radii;
  for (const KernelTap& tap : taps) radii.push_back(glm::length(tap.at));
  std::sort(radii.begin(), radii.end());
  return radii[radii.size() / 2];
}

}  // namespace

SlicePosition find_slice(const BrdfKernel& kernel, double cos_theta) {
  const auto root_of = [&](std::size_t i) { return std::sqrt(double{kernel.slices[i].cos_theta}); };
  if (kernel.slices.size() == 1) return {0, 0, 0};
  std::size_t above = 1;
  while (above + 1 < kernel.slices.size() && root_of(above) < std::sqrt(cos_theta)) ++above;
  const double low = root_of(above - 1);
  const double share = std::clamp((std::sqrt(cos_theta) - low) / (root_of(above) - low), 0.0, 1.0);
  return {above - 1, above, static_cast<float>(share)};
}

float fresnel_factor(const FresnelMap& map, double cos_theta) {
  return map.factor.empty() ? 1 : luminance(lookup_by_cosine(map.factor, static_cast<float>(cos_theta)));
}

std::vector<float> weigh_by_fresnel(KernelTaps& taps, const FresnelMap& map) {
  std::vector<float> means;
  for (int row = 0; row < taps.rows; ++row) {
    const double root = taps.rows > 1 ? row / (taps.rows - 1.0) : 1.0;
    const std::span tap_row =
        std::span(taps.taps).subspan(static_cast<std::size_t>(row * taps.count), static_cast<std::size_t>(taps.count));
    double sum = 0;
    int above = 0;
    for (KernelTap& tap : tap_row) {
      const TapCosines cosines = tap_cosines(tap.at, root * root);
      tap.weight = fresnel_factor(map, cosines.half);
      if (cosines.normal > 0) sum += tap.weight, ++above;
    }
    const float mean = above > 0 ? static_cast<float>(sum / above) : 1.0f;
    for (KernelTap& tap : tap_row) tap.weight = mean > 0 ? tap.weight / mean : 1.0f;
    means.push_back(mean);
  }
  return means;
}

KernelTaps make_kernel_taps(const BrdfKernel& kernel, int count) {
  KernelTaps out;
  if (kernel.size <= 1 || !(kernel.half_extent > 0) || count <= 1) {
    out.taps.push_back({});
    return out;
  }
  std::vector<std::vector<KernelTap>> slices;
  for (const KernelSlice& slice : kernel.slices)
    slices.push_back(
        taps_of(slice.weights, kernel.slice_size, count, [&](const DVec2& at) { return slice_point(slice, at); }));
  out.count = count;
  out.rows = slices.empty() ? kCentredRows : std::max(static_cast<int>(slices.size()), 2);
  for (int i = 0; i < out.rows; ++i) {
    const double root = i / (out.rows - 1.0);
    const auto row =
        slices.empty() ? centred_taps(kernel, count, std::max(root * root, 1e-3)) : lobe_taps(slices, kernel, root);
    out.taps.insert(out.taps.end(), row.begin(), row.end());
  }
  out.median = median_radius(std::span(out.taps).last(static_cast<std::size_t>(count)));
  return out;
}

}  // namespace oriel
