#include "bake/material/kernel.h"

#include <algorithm>
#include <limits>

#include "bake/brdf/quadrature.h"
#include "formats/core/check.h"

namespace oriel {
namespace {

constexpr double kMirrorBelow = 1e-5;       // narrower lobes than any image can resolve
constexpr int kPolar = 512, kAzimuth = 64;  // nodes of the lobe
constexpr int kSubsamples = 4;              // per pixel and axis
constexpr double kBinnedBelow = 0.25;       // cosθ: beneath it the lobe is narrower across than what subsamples catch

struct KernelNode {
  double extent;  // max of |tangents| of the reflected direction; infinite behind the tangent plane
  double weight;  // of the lobe, both sides
  DVec2 tangent;  // x >= 0; undefined where extent is infinite
};

// Weights by counting the lobe's nodes, for grazing lobes: their width across the plane of incidence shrinks with cosθ,
// the nodes follow it.
std::vector<double> binned_weights(const std::vector<KernelNode>& nodes, double half_extent, std::uint32_t size) {
  std::vector<double> weights(std::size_t{size} * size);
  for (const KernelNode& node : nodes) {
    if (node.extent > half_extent) continue;
    const auto at = [&](double t) {
      return std::min(static_cast<std::uint32_t>((t / half_extent + 1) * 0.5 * size), size - 1);
    };
    for (const double x : {-node.tangent.x, node.tangent.x})
      weights[at(node.tangent.y) * size + at(x)] += 0.5 * node.weight;
  }
  return weights;
}

std::vector<KernelNode> tangent_nodes(const LobeFunction& lobe, double alpha, double cos_theta) {
  const MirrorFrame frame(cos_theta);
  std::vector<KernelNode> nodes;
  for (const auto& [wi, weight] : lobe_nodes(lobe, alpha, frame, kPolar, kAzimuth)) {
    const double toward = glm::dot(wi, frame.mirror);
    const DVec2 tangent = DVec2(glm::dot(wi, frame.across), glm::dot(wi, frame.along)) / toward;
    const double extent =
        toward > 0 ? std::max(std::abs(tangent.x), std::abs(tangent.y)) : std::numeric_limits<double>::infinity();
    nodes.push_back({extent, weight, tangent});
  }
  return nodes;
}

struct Extent {
  double half_extent;
  double energy_kept;
};

Extent choose_extent(const std::vector<KernelNode>& unsorted, double alpha, const KernelOptions& options) {
  std::vector<KernelNode> nodes = unsorted;
  std::sort(nodes.begin(), nodes.end(), [](const KernelNode& a, const KernelNode& b) {
    return a.extent != b.extent ? a.extent < b.extent : a.weight < b.weight;
  });
  double total = 0;
  for (const KernelNode& node : nodes) total += node.weight;
  const double largest = std::clamp(static_cast<double>(options.max_half_extent), 1e-3, 100.0);
  if (!(total > 0)) return {std::min(largest, 4 * alpha), 0};
  const double wanted = std::clamp(static_cast<double>(options.energy), 0.01, 0.9999) * total;
  double kept = 0, extent = 0;
  for (const KernelNode& node : nodes) {
    if (node.extent > largest || (kept >= wanted && node.extent > extent)) break;
    kept += node.weight;
    extent = node.extent;
  }
  if (kept < wanted) extent = largest;
  return {std::max(extent, alpha), kept / total};
}

std::uint32_t choose_size(double half_extent, double alpha, std::uint32_t max_size) {
  const double pixels = std::ceil(4 * half_extent / alpha);  // of alpha / 2 each
  const auto limit = std::max(max_size, 3u);
  const auto size = static_cast<std::uint32_t>(std::min<double>(pixels, limit));
  const std::uint32_t odd = size | 1u;
  return std::max(3u, odd > limit ? odd - 2 : odd);
}

// The lobe per unit area of the tangent plane of the mirror direction.
double tangent_density(const LobeFunction& lobe, const MirrorFrame& frame, const DVec2& tangent) {
  const double length2 = 1 + glm::dot(tangent, tangent);
  const DVec3 wi = (frame.mirror + tangent.x * frame.across + tangent.y * frame.along) / std::sqrt(length2);
  // dω = dA / (1 + t²)^(3/2)
  return lobe(frame.wo, wi, glm::normalize(frame.wo + wi)) / (length2 * std::sqrt(length2));
}

// Weights by subsamples of the density in every pixel: smooth, and symmetric where the lobe is. At oblique incidence
// more of them across.
std::vector<double> sampled_weights(const LobeFunction& lobe, double cos_theta, double half_extent,
                                    std::uint32_t size) {
  const int across = static_cast<int>(std::ceil(kSubsamples / cos_theta)), along = kSubsamples;
  const double width = 2 * half_extent / size;
  const MirrorFrame frame(cos_theta);
  std::vector<double> weights;
  weights.reserve(std::size_t{size} * size);
  for (std::uint32_t py = 0; py < size; ++py)
    for (std::uint32_t px = 0; px < size; ++px) {
      double sum = 0;
      for (int y = 0; y < along; ++y)
        for (int x = 0; x < across; ++x) {
          const DVec2 t((px + (x + 0.5) / across) * width, (py + (y + 0.5) / along) * width);
          sum += tangent_density(lobe, frame, t - half_extent);
        }
      weights.push_back(sum);
    }
  return weights;
}

}  // namespace

BrdfKernel make_kernel(float alpha, const LobeOfWidth& lobe_of, float cos_theta, const KernelOptions& options) {
  const double a = alpha <= 1 ? std::max(alpha, 0.0f) : 1;  // NaN: 1
  const double c = cos_theta <= 1 ? std::max(cos_theta, 1e-4f) : 1;
  BrdfKernel kernel;
  kernel.alpha = static_cast<float>(a);
  kernel.cos_theta = static_cast<float>(c);
  kernel.weights = {1.0f};
  if (a < kMirrorBelow) return kernel;

  const LobeFunction lobe = lobe_of(a);
  const std::vector<KernelNode> nodes = tangent_nodes(lobe, a, c);
  const Extent extent = choose_extent(nodes, a, options);
  kernel.half_extent = static_cast<float>(extent.half_extent);
  kernel.energy_kept = static_cast<float>(std::min(extent.energy_kept, 1.0));
  kernel.size = choose_size(extent.half_extent, a, options.max_size);
  const std::vector<double> weights = c < kBinnedBelow ? binned_weights(nodes, extent.half_extent, kernel.size)
                                                       : sampled_weights(lobe, c, extent.half_extent, kernel.size);
  double sum = 0;
  for (const double w : weights) sum += w;
  ORIEL_CHECK(sum > 0 && std::isfinite(sum));
  kernel.weights.resize(weights.size());
  for (std::size_t i = 0; i < weights.size(); ++i) kernel.weights[i] = static_cast<float>(weights[i] / sum);
  return kernel;
}

BrdfKernel make_kernel(float alpha, float cos_theta, const KernelOptions& options) {
  return make_kernel(
      alpha, [](double a) { return microfacet_lobe(FacetModel::kGgx, a); }, cos_theta, options);
}

}  // namespace oriel
