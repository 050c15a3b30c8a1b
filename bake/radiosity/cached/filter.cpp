#include "bake/radiosity/cached/filter.h"

#include "bake/jobs/parallel.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr std::size_t kRun = 1024;
constexpr int kPoolPasses = 4, kWidePasses = 16;

// body(i) for every texel, in parallel.
template <class Body>
void each_texel(Context& context, std::size_t count, const Body& body) {
  (void)parallel_for(context, "", (count + kRun - 1) / kRun, [&](std::size_t run) {
    for (std::size_t i = run * kRun; i < std::min(count, (run + 1) * kRun); ++i) body(i);
  });
}

double total(const Texels& texels, const std::vector<Vec3>& values) {
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    sum += double{texels.area_m2[i]} * (double{values[i].r} + values[i].g + values[i].b);
  return sum;
}

// Conductances of the graph's edges, symmetric, in the order of TexelGraph::of().
using Conductance = std::vector<std::array<float, kMaxNeighbours>>;

// Light by texel with its variance.
struct Guide {
  const std::vector<Vec3>& light;
  const std::vector<Vec3>& variance;

  // Squared difference of two texels over its variance; worst channel decides.
  float distance2(std::size_t i, std::size_t j, float strength) const {
    const Vec3 &a = light[i], &b = light[j], d = a - b;
    const Vec3 s = (variance[i] + variance[j]) * (strength * strength) + 1e-12f * (a * a + b * b) + Vec3(1e-30f);
    return max_component(d * d / s);
  }
};

// Smoothed light tells a gentle slope from noise, but a single dark texel from its surroundings it does not: raw light
// does, though only beyond what noise brings about by itself.
Conductance conductances(const Texels& texels, const TexelGraph& graph, const Guide& smoothed, const Guide& raw,
                         float strength, Context& context) {
  constexpr float kNoiseAlone = 3;  // standard deviations
  Conductance c(texels.count());
  each_texel(context, texels.count(), [&](std::size_t i) {
    const auto own = graph.of(i);
    for (std::size_t k = 0; k < own.size(); ++k) {
      const std::uint32_t j = own[k];
      if (texels.visible[i] < 1 || texels.visible[j] < 1) continue;
      const float beyond = std::max(0.0f, std::sqrt(raw.distance2(i, j, 1)) - kNoiseAlone);
      const float likeness = std::exp(-0.5f * (smoothed.distance2(i, j, strength) + beyond * beyond));
      c[i][k] = std::min(texels.area_m2[i], texels.area_m2[j]) / (kMaxNeighbours + 1) * likeness;
    }
  });
  return c;
}

std::vector<Vec3> diffuse(const Texels& texels, const TexelGraph& graph, const Conductance& conductance,
                          std::vector<Vec3> values, int passes, Context& context) {
  std::vector<Vec3> next(values.size());
  for (int pass = 0; pass < passes; ++pass) {
    each_texel(context, values.size(), [&](std::size_t i) {
      Vec3 gain(0);
      const auto own = graph.of(i);
      for (std::size_t k = 0; k < own.size(); ++k) gain += conductance[i][k] * (values[own[k]] - values[i]);
      next[i] = values[i] + (texels.area_m2[i] > 0 ? gain / texels.area_m2[i] : Vec3(0));
    });
    values.swap(next);
  }
  return values;
}

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

// Texels are no points: what rays find within one is taken as linear, and what that changed against its mean tells how
// much may be left. The halves' product has no noise of its own.
Vec3 left_by_slopes(const HalfSums& sums, std::size_t i) {
  constexpr float kLeft = 0.5f;  // of the change
  const float n = static_cast<float>(std::max(1u, sums.samples[i]));
  return (kLeft * kLeft / (n * n)) * sums.slope[0][i] * sums.slope[1][i];
}

}  // namespace

Halves halves_of(const HalfSums& sums, Context& context) {
  const std::size_t n = sums.samples.size();
  Halves halves;
  for (auto& light : halves.light) light.resize(n);
  halves.common.resize(n), halves.beside.resize(n);
  each_texel(context, n, [&](std::size_t i) {
    for (int h = 0; h < kHalves; ++h) halves.light[h][i] = sums.half(h, i);
    halves.common[i] = left_by_slopes(sums, i);
  });
  return halves;
}

Halves halves_of(const DirectSums& sums, const std::vector<Vec3>& gathered) {
  Halves halves{{sums.value, sums.value}, std::vector<Vec3>(sums.value.size()), gathered};
  for (std::size_t i = 0; i < sums.value.size(); ++i) {
    halves.light[0][i] += 0.5f * sums.difference[i];
    halves.light[1][i] -= 0.5f * sums.difference[i];
  }
  return halves;
}

std::vector<Vec4> smoothed_moments(const TexelGraph& graph, const HalfSums& sums, Context& context) {
  std::vector<Vec4> moments = sums.moments;
  for (std::size_t i = 0; i < moments.size(); ++i)
    moments[i] = moments[i] / static_cast<float>(kHalves * std::max(1u, sums.samples[i])) + sums.beside_moments[i];
  return pooled(graph, std::move(moments), 1, context);
}

std::vector<float> typical_errors(const TexelGraph& graph, std::vector<float> errors, Context& context) {
  return pooled(graph, std::move(errors), kWidePasses, context);
}

std::vector<Vec3> pooled_errors(const Texels& texels, const TexelGraph& graph, std::vector<Vec3> squares,
                                const std::vector<Vec3>& light, Context& context) {
  DVec3 mean(0);
  double seen = 0;
  for (std::size_t i = 0; i < light.size(); ++i) mean += DVec3(light[i]), seen += texels.visible[i] > 0;
  const Vec3 floor = Vec3(mean / std::max(1.0, seen)) * 0.01f;
  const auto scale = [&](std::size_t i) { return light[i] * light[i] + floor * floor + Vec3(1e-30f); };
  each_texel(context, squares.size(), [&](std::size_t i) { squares[i] /= scale(i); });
  const auto spread = [&](const auto& share) {
    std::vector<Vec3> near = pooled(graph, squares, kPoolPasses, share, context);
    const std::vector<Vec3> wide = pooled(graph, near, kWidePasses - kPoolPasses, share, context);
    for (std::size_t i = 0; i < near.size(); ++i) near[i] = 0.5f * (near[i] + wide[i]);
    return near;
  };
  const auto crowded = [&](std::size_t i, std::size_t j) { return texels.has_many[i] && texels.has_many[j]; };
  std::vector<Vec3> of_all = spread([](std::size_t, std::size_t) { return true; });
  // What is close to a surface is met by paths: more noise than beside it.
  const std::vector<Vec3> of_crowded = spread(crowded);
  for (std::size_t i = 0; i < squares.size(); ++i)
    squares[i] = texels.has_many[i] ? glm::max(of_all[i], of_crowded[i]) : of_all[i];
  each_texel(context, squares.size(), [&](std::size_t i) { squares[i] *= scale(i); });
  return squares;
}

float mean_luminance(const Texels& texels, const std::vector<Vec3>& direct, const std::vector<Vec3>& gathered) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < texels.count(); ++i)
    if (texels.visible[i] > 0) sum += static_cast<double>(luminance(direct[i] + gathered[i])), ++count;
  return static_cast<float>(sum / std::max(1.0, count));
}

Estimate filter(const Texels& texels, const TexelGraph& graph, const Halves& halves, const FilterOptions& options,
                Context& context) {
  const std::size_t n = texels.count();
  const auto& half = halves.light;
  std::vector<Vec3> noise(n), mean(n);
  each_texel(context, n, [&](std::size_t i) {
    const Vec3 d = half[0][i] - half[1][i];
    mean[i] = 0.5f * (half[0][i] + half[1][i]);
    noise[i] = 0.5f * d * d;  // variance of one half
  });
  const auto pool = [&](std::vector<Vec3> squares, std::vector<Vec3> light) {
    for (std::size_t i = 0; i < n; ++i) light[i] += halves.beside[i];
    return pooled_errors(texels, graph, std::move(squares), light, context);
  };
  // The guide is itself smoothed a little, so that its noise does not choose whom to join.
  const std::vector<Vec3> guide = pooled(graph, mean, 1, context);
  const std::vector<Vec3> raw_noise = pool(noise, mean);
  noise = pool(std::move(noise), guide);
  const std::vector<Vec3> left = pool(halves.common, guide);

  Estimate result;
  if (options.strength <= 0 || options.passes <= 0) {
    result.value = mean;
    result.variance = noise;
    for (std::size_t i = 0; i < n; ++i) result.variance[i] = 0.5f * result.variance[i] + glm::max(left[i], Vec3(0));
    return result;
  }
  std::vector<Vec3> guide_variance = noise;
  for (Vec3& v : guide_variance) v *= 0.5f / 3;
  std::vector<Vec3> raw_variance = raw_noise;
  for (Vec3& v : raw_variance) v *= 0.5f;
  const Conductance c =
      conductances(texels, graph, {guide, guide_variance}, {mean, raw_variance}, options.strength, context);
  std::vector<Vec3> smooth[kHalves];
  for (int h = 0; h < kHalves; ++h) smooth[h] = diffuse(texels, graph, c, half[h], options.passes, context);

  result.value.resize(n), result.variance.resize(n);
  std::vector<Vec3> beyond(n), of_both(n);
  each_texel(context, n, [&](std::size_t i) {
    result.value[i] = 0.5f * (smooth[0][i] + smooth[1][i]);
    const Vec3 d = smooth[0][i] - smooth[1][i], unfiltered = half[0][i] - half[1][i];
    of_both[i] = 0.25f * d * d;  // noise of the mean of both
    // error(F_a) = E|F_a - b|² - noise(b) = bias² + noise(F_a); the mean of both has bias² + noise(F_a) / 2.
    for (int h = 0; h < kHalves; ++h) {
      const Vec3 to_other = smooth[h][i] - half[1 - h][i];
      beyond[i] += 0.5f * to_other * to_other;
    }
    beyond[i] -= 0.5f * unfiltered * unfiltered + of_both[i];
  });
  // Relative to the light that the filter leaves, as the error asked for is.
  beyond = pool(std::move(beyond), result.value);
  of_both = pool(std::move(of_both), result.value);
  each_texel(context, n, [&](std::size_t i) {
    result.variance[i] = glm::max(beyond[i], of_both[i]);
    result.variance[i] += glm::max(left[i], Vec3(0));
  });
  const double before = total(texels, mean), after = total(texels, result.value);
  result.energy_drift = before > 0 ? after / before - 1 : 0;
  return result;
}

}  // namespace oriel
