// Conservative diffusion of light over the graph of texels, and pooling of what is told of them.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "bake/jobs/parallel.h"
#include "bake/radiosity/texels/neighbours.h"

namespace oriel {

// body(i) for every texel, in parallel.
template <class Body>
void each_texel(Context& context, std::size_t count, const Body& body) {
  constexpr std::size_t kRun = 1024;
  (void)parallel_for(context, "", (count + kRun - 1) / kRun, [&](std::size_t run) {
    for (std::size_t i = run * kRun; i < std::min(count, (run + 1) * kRun); ++i) body(i);
  });
}

// Conductances of the graph's edges over the area of their first texel, in the order of TexelGraph::of(). Times areas
// they are symmetric, so that what one texel gains its neighbour loses.
using Conductance = std::vector<std::array<float, kMaxNeighbours>>;

// Light by texel, or what it has beside that around, with its variance.
struct Guide {
  const std::vector<Vec3>& light;
  const std::vector<Vec3>& variance;
  float strength = 1;      // standard deviations are as many times as wide
  bool everywhere = true;  // whether it tells texels apart that nothing stands or hangs close to

  // Squared difference of two texels over its variance; worst channel decides.
  float distance2(std::size_t i, std::size_t j) const {
    const Vec3 &a = light[i], &b = light[j], d = a - b;
    const Vec3 s = (variance[i] + variance[j]) * (strength * strength) + 1e-12f * (a * a + b * b) + Vec3(1e-30f);
    return max_component(d * d / s);
  }
};

// Smoothed light tells a gentle slope from noise, but a single dark texel from its surroundings it does not: raw light
// does, though only beyond what noise brings about by itself. Texels partly inside other bodies join nobody.
Conductance conductances(const Texels& texels, const TexelGraph& graph, const Guide& smoothed, const Guide& raw,
                         Context& context);

// What light diffuses over.
struct Conductor {
  const TexelGraph& graph;
  const Conductance& conductance;
};

// Steps of explicit diffusion that together last `time`, in units of the longest that is stable alone. Short times take
// that one. Longer ones two cycles of n steps, each of which lasts (n² + n) / 3 (fast explicit diffusion: Grewenig,
// Weickert & Bruhn 2010), in an order in which rounding errors do not grow (Leja's). A cycle alone is a box, which lets
// 1 / (2n + 1) of the finest noise pass; two leave its square.
std::vector<float> diffusion_steps(float time);

// `values` after that time: light spreads by √(2 time / 3) texels along each axis of a plain surface, and keeps its sum
// over texels weighed by area.
template <class V>
std::vector<V> diffuse(const Conductor& over, std::vector<V> values, float time, Context& context) {
  const TexelGraph& graph = over.graph;
  const Conductance& conductance = over.conductance;
  std::vector<V> next(values.size());
  for (const float step : diffusion_steps(time)) {
    each_texel(context, values.size(), [&](std::size_t i) {
      V gain(0);
      const auto own = graph.of(i);
      for (std::size_t k = 0; k < own.size(); ++k) gain += conductance[i][k] * (values[own[k]] - values[i]);
      next[i] = values[i] + step * gain;
    });
    values.swap(next);
  }
  return values;
}

// Along each edge of the graph, into its first texel, in the order of TexelGraph::of(): times the texel's area, what
// the other one loses.
using Flow = std::vector<std::array<Vec3, kMaxNeighbours>>;

// The flow that smooths `values` over that time. Diffusion changes light that bends, by as much again in the same time
// once more: its flow less that of the next such time leaves quadratic light as it is, and linear light also where a
// surface ends (twicing, Tukey 1977).
Flow further_flow(const Conductor& over, std::vector<Vec3> values, float time, Context& context);

// A quantity spread over each texel's surroundings, `passes` wide. Its sum over texels stays: what a texel gains its
// neighbour loses, so that errors at rims and in corners, where the filter's bias is greatest, count in full. share(i,
// j): whether these two have a common quantity at all.
template <class V, class Share>
std::vector<V> pooled(const TexelGraph& graph, std::vector<V> values, int passes, const Share& share,
                      Context& context) {
  std::vector<V> next(values.size());
  for (int pass = 0; pass < passes; ++pass) {
    each_texel(context, values.size(), [&](std::size_t i) {
      V gain(0);
      for (const std::uint32_t j : graph.of(i))
        if (share(i, j)) gain += values[j] - values[i];
      next[i] = values[i] + gain / static_cast<float>(kMaxNeighbours + 1);
    });
    values.swap(next);
  }
  return values;
}

template <class V>
std::vector<V> pooled(const TexelGraph& graph, std::vector<V> values, int passes, Context& context) {
  return pooled(
      graph, std::move(values), passes, [](std::size_t, std::size_t) { return true; }, context);
}

}  // namespace oriel
