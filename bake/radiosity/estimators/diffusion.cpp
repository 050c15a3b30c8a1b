#include "bake/radiosity/estimators/diffusion.h"

#include <algorithm>

namespace oriel {
namespace {

constexpr float kPlainSteps = 8;

}  // namespace

Conductance conductances(const Texels& texels, const TexelGraph& graph, const Guide& smoothed, const Guide& raw,
                         Context& context) {
  constexpr float kNoiseAlone = 3;  // standard deviations
  const auto area_of = [&](std::size_t i) { return texels.meets_gap[i] ? 0 : texels.area_m2[i] * texels.visible[i]; };
  Conductance c(texels.count());
  each_texel(context, texels.count(), [&](std::size_t i) {
    const auto own = graph.of(i);
    for (std::size_t k = 0; k < own.size(); ++k) {
      const std::uint32_t j = own[k];
      const float area = area_of(i), other = area_of(j);
      if (area <= 0 || other <= 0) continue;
      const bool tells = raw.everywhere || texels.occlusion_heavy[i] || texels.occlusion_heavy[j];
      const float beyond = tells ? std::max(0.0f, std::sqrt(raw.distance2(i, j)) - kNoiseAlone) : 0;
      float likeness = std::exp(-0.5f * (smoothed.distance2(i, j) + beyond * beyond));
      if (texels.visible[i] < 1 || texels.visible[j] < 1) likeness *= raw.noise_share(i, j);
      c[i][k] = std::min(1.0f, other / area) / (kMaxNeighbours + 1) * likeness;
    }
  });
  return c;
}

std::vector<float> diffusion_steps(float time) {
  if (time <= kPlainSteps) return std::vector<float>(static_cast<std::size_t>(std::ceil(time)), time / std::ceil(time));
  // The smallest n with (n² + n) / 3 >= the cycle's time; all steps are then shortened by the same factor.
  const double cycle = 0.5 * double{time};
  const double n = std::ceil(std::sqrt(3 * cycle + 0.25) - 0.5 - 1e-6), shortened = 3 * cycle / (n * n + n);
  std::vector<double> rate, product;  // 1 / step; product of its differences to those chosen before
  for (int i = 0; i < static_cast<int>(n); ++i) {
    const double c = std::cos(kPi * (2 * i + 1) / (4 * n + 2));
    rate.push_back(2 * c * c), product.push_back(1);
  }
  std::vector<float> steps;
  while (!rate.empty()) {
    const auto next = std::max_element(product.begin(), product.end()) - product.begin();
    const double chosen = rate[static_cast<std::size_t>(next)];
    steps.push_back(static_cast<float>(shortened / chosen));
    rate.erase(rate.begin() + next), product.erase(product.begin() + next);
    for (std::size_t k = 0; k < rate.size(); ++k) product[k] *= std::fabs(rate[k] - chosen);
  }
  const std::vector<float> first = steps;
  steps.insert(steps.end(), first.begin(), first.end());
  return steps;
}

Flow further_flow(const Conductor& over, std::vector<BothHalves> values, float time, Context& context) {
  const TexelGraph& graph = over.graph;
  const Conductance& conductance = over.conductance;
  const std::size_t n = values.size();
  std::vector<BothHalves> next(n), sum(n, BothHalves(0));
  // Conductances are constant in time: an edge's flow is that of the values summed over steps.
  const std::vector<float> steps = diffusion_steps(time);
  for (const float sign : {1.0f, -1.0f})
    for (const float step : steps) {
      each_texel(context, n, [&](std::size_t i) {
        BothHalves gain(0);
        const auto own = graph.of(i);
        for (std::size_t k = 0; k < own.size(); ++k) gain += conductance[i][k] * (values[own[k]] - values[i]);
        sum[i] += sign * step * values[i];
        next[i] = values[i] + step * gain;
      });
      values.swap(next);
    }
  Flow flow(n);
  each_texel(context, n, [&](std::size_t i) {
    const auto own = graph.of(i);
    for (std::size_t k = 0; k < own.size(); ++k) flow[i][k] = conductance[i][k] * (sum[own[k]] - sum[i]);
  });
  return flow;
}

}  // namespace oriel
