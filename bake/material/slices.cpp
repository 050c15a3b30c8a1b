#include "bake/material/slices.h"

#include <algorithm>

#include "bake/trace/lobe_fit.h"
#include "formats/core/check.h"
#include "formats/core/half.h"

namespace oriel {
namespace {

constexpr int kSlicePolar = 128, kSliceAzimuth = 32;  // nodes of the lobe
constexpr int kSliceSubsamples = 4;                   // per pixel and axis

struct SliceNode {
  DVec2 u;  // mirror coordinates, x >= 0
  double weight;
};

DVec3 unproject(const MirrorFrame& frame, const DVec2& u) {
  const double q = 0.25 * glm::dot(u, u);  // tan²(γ/2)
  return ((1 - q) * frame.mirror + u.x * frame.across + u.y * frame.along) / (1 + q);
}

DVec2 project(const MirrorFrame& frame, const DVec3& wi) {
  const double away = std::max(1 + glm::dot(wi, frame.mirror), 1e-12);  // 2 / (1 + tan²(γ/2))
  return DVec2(glm::dot(wi, frame.across), glm::dot(wi, frame.along)) * (2 / away);
}

std::vector<SliceNode> projected_nodes(const LobeFunction& lobe, double alpha, const MirrorFrame& frame) {
  std::vector<SliceNode> nodes;
  for (const LobeNode& node : lobe_nodes(lobe, alpha, frame, kSlicePolar, kSliceAzimuth))
    nodes.push_back({project(frame, node.wi), node.weight});
  return nodes;
}

// A coordinate of the nodes, sorted, with its running weight.
class Distribution {
 public:
  template <class Key>
  Distribution(const std::vector<SliceNode>& nodes, const Key& key) {
    for (const SliceNode& node : nodes) values_.emplace_back(key(node), node.weight);
    std::sort(values_.begin(), values_.end());
    double sum = 0;
    for (auto& [value, weight] : values_) weight = sum += weight;
  }
  // The value below which `share` of the weight lies.
  double quantile(double share) const {
    const auto at = std::partition_point(values_.begin(), values_.end() - 1,
                                         [&](const auto& v) { return v.second < share * values_.back().second; });
    return at->first;
  }
  // The share of the weight up to a value.
  double share(double value) const {
    const auto at =
        std::partition_point(values_.begin(), values_.end(), [&](const auto& v) { return v.first <= value; });
    return at == values_.begin() ? 0.0 : (at - 1)->second / values_.back().second;
  }

 private:
  std::vector<std::pair<double, double>> values_;
};

float as_half(double value) {
  return float_from_half(half_from_float(static_cast<float>(value)));
}

// Halves whose sum is 1 but for rounding, as a pack holds them: what they miss goes to the heaviest of the middle
// column, which has no twin.
void make_whole(std::vector<float>& weights, std::uint32_t size) {
  std::vector<float*> middle;
  for (std::uint32_t y = 0; y < size; ++y) middle.push_back(&weights[y * size + size / 2]);
  std::ranges::sort(middle, [](const float* a, const float* b) { return *a > *b; });
  double missing = 1;
  for (const float w : weights) missing -= w;
  for (float* weight : middle) {
    const float before = *weight;
    *weight = as_half(std::max(0.0, before + missing));
    missing -= *weight - before;
  }
}

std::vector<float> integrate_pixels(const LobeFunction& lobe, const MirrorFrame& frame, const KernelSlice& slice,
                                    std::uint32_t size) {
  std::vector<double> sums(std::size_t{size} * size);
  double total = 0;
  for (std::uint32_t y = 0; y < size; ++y)
    for (std::uint32_t x = 0; x <= size / 2; ++x) {
      double sum = 0;
      for (int s = 0; s < kSliceSubsamples * kSliceSubsamples; ++s) {
        const DVec2 in_pixel = (DVec2(s % kSliceSubsamples, s / kSliceSubsamples) + 0.5) / double(kSliceSubsamples);
        const DVec2 u = slice_point(slice, (DVec2(x, y) + in_pixel) / double(size));
        // dω = dA / q², and du = width cosh(s) ds
        const double q = 1 + 0.25 * glm::dot(u, u);
        const DVec2 sinh_s = (u - DVec2(0, slice.shift)) / DVec2(slice.width);
        const double stretch = std::sqrt((1 + sinh_s.x * sinh_s.x) * (1 + sinh_s.y * sinh_s.y));
        const DVec3 wi = unproject(frame, u);
        sum += lobe(frame.wo, wi, glm::normalize(frame.wo + wi)) * stretch / (q * q);
      }
      sums[y * size + x] = sums[y * size + size - 1 - x] = sum;
      total += x == size / 2 ? sum : 2 * sum;
    }
  ORIEL_CHECK(total > 0 && std::isfinite(total));
  std::vector<float> weights;
  weights.reserve(sums.size());
  for (const double sum : sums) weights.push_back(as_half(sum / total));
  make_whole(weights, size);
  return weights;
}

}  // namespace

KernelSlice make_slice(const LobeFunction& lobe, double alpha, double cos_theta, const SliceOptions& options) {
  const MirrorFrame frame(cos_theta);
  const std::vector<SliceNode> nodes = projected_nodes(lobe, alpha, frame);
  double total = 0;
  DVec3 mean(0);
  for (const SliceNode& node : nodes) {
    total += node.weight;
    mean += node.weight * unproject(frame, node.u);
  }
  ORIEL_CHECK(total > 0 && std::isfinite(total));
  const double tail = 1 - std::clamp(static_cast<double>(options.energy), 0.5, 0.9999);
  const Distribution along(nodes, [](const SliceNode& node) { return node.u.y; });
  const Distribution across(nodes, [](const SliceNode& node) { return node.u.x; });
  const Distribution around(nodes, [](const SliceNode& node) { return glm::length(node.u); });

  KernelSlice slice;
  slice.cos_theta = static_cast<float>(cos_theta);
  slice.albedo = static_cast<float>(std::min(total, 1.0));
  slice.tilt_rad = static_cast<float>(std::atan2(glm::dot(mean, frame.along), glm::dot(mean, frame.mirror)));
  slice.shift = static_cast<float>(along.quantile(0.5));
  slice.width = DVec2(across.quantile(0.5), 0.5 * (along.quantile(0.75) - along.quantile(0.25)));
  const auto in_s = [&](double u) { return static_cast<float>(std::asinh((u - slice.shift) / slice.width.y)); };
  slice.upper = {static_cast<float>(std::asinh(across.quantile(1 - 0.5 * tail) / slice.width.x)),
                 in_s(along.quantile(1 - 0.25 * tail))};
  slice.lower = {-slice.upper.x, in_s(along.quantile(0.25 * tail))};
  slice.radial_extent = static_cast<float>(around.quantile(1 - tail));
  const std::uint32_t entries = std::max(options.radial, 2u);
  for (std::uint32_t i = 0; i < entries; ++i)
    slice.radial.push_back(static_cast<float>(around.share(slice.radial_extent * std::pow(i / (entries - 1.0), 2))));
  const DVec2 low = slice_point(slice, {0, 0}), high = slice_point(slice, {1, 1});
  double kept = 0;
  for (const SliceNode& node : nodes)
    if (node.u.x <= high.x && node.u.y >= low.y && node.u.y <= high.y) kept += node.weight;
  slice.energy_kept = static_cast<float>(std::min(kept / total, 1.0));
  slice.weights = integrate_pixels(lobe, frame, slice, std::max(options.size | 1u, 3u));
  return slice;
}

void add_slices(BrdfKernel& kernel, const SliceOptions& options) {
  if (kernel.size <= 1) return;
  const LobeFunction lobe = microfacet_lobe(FacetModel::kGgx, kernel.alpha);
  const std::uint32_t count = std::max(options.count, 2u);
  kernel.slice_size = std::max(options.size | 1u, 3u);
  for (std::uint32_t i = 0; i < count; ++i) {
    const double root = i / (count - 1.0), cos_theta = std::max(root * root, static_cast<double>(kGrazingCosine));
    kernel.slices.push_back(make_slice(lobe, kernel.alpha, cos_theta, options));
    kernel.fits.push_back(fit_lobe(lobe, kernel.alpha, cos_theta));
  }
}

}  // namespace oriel
