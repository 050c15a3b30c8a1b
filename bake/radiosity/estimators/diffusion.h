// Conservative diffusion of light over the graph of texels, and pooling of per-texel statistics.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "bake/jobs/parallel.h"
#include "bake/radiosity/texels/neighbours.h"

namespace oriel {

// Calls body(i) for every texel, in parallel.
template <class Body>
void each_texel(Context& context, std::size_t count, const Body& body) {
  constexpr std::size_t kRun = 1024;
  (void)parallel_for(context, "", (count + kRun - 1) / kRun, [&](std::size_t run) {
    for (std::size_t i = run * kRun; i < std::min(count, (run + 1) * kRun); ++i) body(i);
  });
}

// Conductances of the graph's edges over the visible area of their first texel, in the order of TexelGraph::of(). Times
// that area they are symmetric: a texel gains as much as its neighbour loses.
using Conductance = std::vector<std::array<float, kMaxNeighbours>>;

// A guide image of the filter: light by texel, or its deviation from its neighbourhood, with the variance of that.
struct Guide {
  const std::vector<Vec3>& light;
  const std::vector<Vec3>& variance;
  float strength = 1;                               // factor of the standard deviations
  bool everywhere = true;                           // false: it separates occlusion-heavy texels only
  const std::vector<Vec3>* own_variance = nullptr;  // by the two halves of a texel alone

  // The squared difference of two texels over its variance, in the worst channel.
  float distance2(std::size_t i, std::size_t j) const {
    const Vec3 &a = light[i], &b = light[j], d = a - b;
    const Vec3 s = (variance[i] + variance[j]) * (strength * strength) + 1e-12f * (a * a + b * b) + Vec3(1e-30f);
    return max_component(d * d / s);
  }
  // The share of that difference, squared, that the halves of both texels tell to be noise: at most 1.
  float noise_share(std::size_t i, std::size_t j) const {
    if (!own_variance) return 1;
    const Vec3 d = light[i] - light[j], noise = (*own_variance)[i] + (*own_variance)[j] + Vec3(1e-30f);
    return 1 / std::max(1.0f, max_component(d * d / noise));
  }
};

// Conductances by two guides. Smoothed light distinguishes a gentle slope from noise, but not a single dark texel from
// its neighbourhood: raw light does, for differences beyond its noise. Light really
// differs at the foot of a wall: a texel partly inside it has an edge as far as its own noise explains the difference.
// Texels that meet a gap have none.
Conductance conductances(const Texels& texels, const TexelGraph& graph, const Guide& smoothed, const Guide& raw,
                         Context& context);

// The graph with its conductances.
struct Conductor {
  const TexelGraph& graph;
  const Conductance& conductance;
};

// Steps of explicit diffusion that sum to `time`, in units of the longest stable single step. A short time takes such
// steps. A longer one takes two cycles of n steps, each of which lasts (n² + n) / 3 (fast explicit diffusion: Grewenig,
// Weickert & Bruhn 2010), in an order that keeps rounding errors bounded (Leja's). One cycle is a box filter, which
// passes 1 / (2n + 1) of the finest noise; two pass its square.
std::vector<float> diffusion_steps(float time);

// Returns `values` after diffusion for `time`: light spreads by √(2 time / 3) texels along each axis of a plane. The
// area-weighted sum stays.
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

// Light by half of the estimate: one walk over the graph serves both.
using BothHalves = glm::mat<kHalves, 3, float>;

// The flow along each edge into its first texel, in the order of TexelGraph::of(). Times the texel's area it is the
// other texel's loss.
using Flow = std::vector<std::array<BothHalves, kMaxNeighbours>>;

// The flow that smooths `values` over `time`, with the filter's bias corrected by twicing (Tukey 1977): diffusion for
// the same time once more repeats the bias, so that second flow is subtracted. Quadratic light is left unchanged, and
// linear light also at the end of a surface.
Flow further_flow(const Conductor& over, std::vector<BothHalves> values, float time, Context& context);

// Averages a quantity over each texel's neighbourhood, `passes` wide. The sum over texels stays, so that errors at rims
// and in corners, where the filter's bias is largest, keep their weight. part: by texel, those that exchange the
// quantity; null: all.
template <class V>
std::vector<V> pooled(const TexelGraph& graph, std::vector<V> values, int passes, Context& context,
                      const std::vector<char>* part = nullptr) {
  std::vector<V> next(values);
  for (int pass = 0; pass < passes; ++pass) {
    each_texel(context, values.size(), [&](std::size_t i) {
      if (part && !(*part)[i]) return;
      V gain(0);
      for (const std::uint32_t j : graph.of(i))
        if (!part || (*part)[j]) gain += values[j] - values[i];
      next[i] = values[i] + gain / static_cast<float>(kMaxNeighbours + 1);
    });
    values.swap(next);
  }
  return values;
}

}  // namespace oriel
