#include "bake/radiosity/estimators/filter.h"

#include "bake/radiosity/estimators/diffusion.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr int kPoolPasses = 4, kWidePasses = 16, kNeighbourPasses = 4;
// Diffusion times of the scales: each scale doubles the width of the kernel so far.
constexpr float kNarrow = 2, kByChance = 4;
constexpr float kFirstScale = 6, kNextScale = 4, kPooledOver = 4;

double total(const Texels& texels, const std::vector<Vec3>& values) {
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    sum += double{texels.area_m2[i]} * double{texels.visible[i]} * (double{values[i].r} + values[i].g + values[i].b);
  return sum;
}

using TwoHalves = std::array<std::vector<Vec3>, kHalves>;

// The fraction of a texel's variance left after one pass of pooled(). At the end of a surface, with few neighbours,
// most of it is left.
float remaining_noise(std::size_t neighbours) {
  constexpr float kShare = 1.0f / (kMaxNeighbours + 1);
  const auto n = static_cast<float>(neighbours);
  const float own = 1 - n * kShare;
  return own * own + n * kShare * kShare;
}

// Per texel, 1 over its squared light (at least 1 % of the mean), for relative errors.
std::vector<float> relative_to(const Texels& texels, const std::vector<Vec3>& light,
                               const std::vector<Vec3>& additional) {
  const float floor = 0.01f * mean_luminance(texels, light, additional);
  std::vector<float> weight(light.size());
  for (std::size_t i = 0; i < light.size(); ++i) {
    const float l = luminance(light[i] + additional[i]);
    weight[i] = 1 / (l * l + floor * floor + 1e-30f);
  }
  return weight;
}

// Per texel, [0,1]: the fraction of the change Δ by further smoothing that minimises the error (Wiener 1949). <> is a
// mean over the neighbourhood. The common change of both halves, <Δ_0 Δ_1>, is signal; their different change, <(Δ_0 -
// Δ_1)²> / 4, is noise removed from the mean of both. The optimum is the second over the sum.
std::vector<float> wanted(const Conductor& over, const std::vector<BothHalves>& change,
                          const std::vector<float>& weight, float time, Context& context) {
  std::vector<Vec2> sums(weight.size());
  each_texel(context, sums.size(), [&](std::size_t i) {
    const Vec3 &a = change[i][0], &b = change[i][1];
    sums[i] = weight[i] * Vec2(0.25f * glm::dot(a - b, a - b), glm::dot(a, b));
  });
  const std::vector<Vec2> near = diffuse(over, sums, kNarrow, context);
  sums = diffuse(over, std::move(sums), kPooledOver * time, context);
  std::vector<float> share(sums.size());
  for (std::size_t i = 0; i < share.size(); ++i) {
    const float noise = std::max(0.0f, sums[i].x);
    const float light = std::max({0.0f, sums[i].y, near[i].y - kByChance * noise});
    share[i] = noise > 0 ? noise / (noise + light) : light > 0 ? 0.0f : 1.0f;
  }
  return share;
}

// The flow into each texel: an edge's flow times the smaller `share` of its two texels, which conserves light.
std::vector<BothHalves> gain(const Flow& flow, const TexelGraph& graph, const std::vector<float>& share,
                             Context& context) {
  std::vector<BothHalves> sum(share.size(), BothHalves(0));
  each_texel(context, share.size(), [&](std::size_t i) {
    const auto own = graph.of(i);
    for (std::size_t k = 0; k < own.size(); ++k) sum[i] += std::min(share[i], share[own[k]]) * flow[i][k];
  });
  return sum;
}

// Smooths both halves on scale after scale, each only where that removes noise.
void smooth_by_scales(const Conductor& over, const std::vector<float>& weight, int scales, TwoHalves& halves,
                      Context& context) {
  const std::vector<float> all(weight.size(), 1.0f);
  std::vector<BothHalves> light(weight.size());
  for (std::size_t i = 0; i < light.size(); ++i) light[i] = BothHalves(halves[0][i], halves[1][i]);
  float time = kFirstScale;
  for (int scale = 0; scale < scales; ++scale, time *= kNextScale) {
    const Flow flow = further_flow(over, light, time, context);
    std::vector<float> share = all;
    if (scale > 0) share = wanted(over, gain(flow, over.graph, all, context), weight, time, context);
    const std::vector<BothHalves> change = gain(flow, over.graph, share, context);
    for (std::size_t i = 0; i < change.size(); ++i) light[i] += change[i];
  }
  for (std::size_t i = 0; i < light.size(); ++i) halves[0][i] = light[i][0], halves[1][i] = light[i][1];
}

// The deviation of a texel's light from its neighbourhood, so that a slope is no edge, however steep. With the light
// itself as guide, texels on a slope joined only those on their own level, and noise became contour lines.
std::vector<Vec3> deviation_from_neighbours(const TexelGraph& graph, std::vector<Vec3> light, Context& context) {
  const std::vector<Vec3> neighbourhood = pooled(graph, light, kNeighbourPasses, context);
  for (std::size_t i = 0; i < light.size(); ++i) light[i] -= neighbourhood[i];
  return light;
}

// The squared error of linear light within the texels hit, as a fraction of the change by their slopes. The product of
// the halves has no noise bias.
Vec3 slope_error(const HalfSums& sums, std::size_t i) {
  constexpr float kLeft = 0.5f;  // of the change
  const float n = static_cast<float>(std::max(1u, sums.samples[i]));
  return (kLeft * kLeft / (n * n)) * sums.slope[0][i] * sums.slope[1][i];
}

// Per texel, the squared error of the mean of both halves: error(F_a) = E|F_a - b|² - noise(b) = bias² + noise(F_a);
// the mean of both has bias² + noise(F_a) / 2. To be pooled.
std::vector<Vec3> beyond_noise(const TwoHalves& half, const TwoHalves& smooth, Context& context) {
  std::vector<Vec3> beyond(half[0].size());
  each_texel(context, beyond.size(), [&](std::size_t i) {
    const Vec3 d = smooth[0][i] - smooth[1][i], unfiltered = half[0][i] - half[1][i];
    for (int h = 0; h < kHalves; ++h) {
      const Vec3 to_other = smooth[h][i] - half[1 - h][i];
      beyond[i] += 0.5f * to_other * to_other;
    }
    beyond[i] -= 0.5f * unfiltered * unfiltered + 0.25f * d * d;
  });
  return beyond;
}

}  // namespace

Halves halves_of(const HalfSums& sums, Context& context) {
  const std::size_t n = sums.samples.size();
  Halves halves;
  for (auto& light : halves.light) light.resize(n);
  halves.common.resize(n), halves.additional.resize(n);
  halves.steps = false;
  each_texel(context, n, [&](std::size_t i) {
    for (int h = 0; h < kHalves; ++h) halves.light[h][i] = sums.half(h, i);
    halves.common[i] = slope_error(sums, i);
  });
  return halves;
}

Halves halves_of(const DirectSums& sums, const std::vector<Vec3>& gathered) {
  Halves halves{{sums.value, sums.value}, std::vector<Vec3>(sums.value.size()), gathered};
  for (std::size_t i = 0; i < sums.value.size(); ++i) {
    halves.additional[i] += sums.sharp[i];
    halves.light[0][i] += 0.5f * sums.difference[i] - sums.sharp[i];
    halves.light[1][i] -= 0.5f * sums.difference[i] + sums.sharp[i];
  }
  return halves;
}

std::vector<Vec4> smoothed_moments(const TexelGraph& graph, const HalfSums& sums, Context& context) {
  std::vector<Vec4> moments = sums.moments;
  for (std::size_t i = 0; i < moments.size(); ++i)
    moments[i] = moments[i] / static_cast<float>(kHalves * std::max(1u, sums.samples[i])) + sums.additional_moments[i];
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
  const auto spread = [&](const std::vector<char>* part) {
    std::vector<Vec3> near = pooled(graph, squares, kPoolPasses, context, part);
    const std::vector<Vec3> wide = pooled(graph, near, kWidePasses - kPoolPasses, context, part);
    for (std::size_t i = 0; i < near.size(); ++i) near[i] = 0.5f * (near[i] + wide[i]);
    return near;
  };
  const std::vector<Vec3> of_all = spread(nullptr);
  // Paths start from hits close to an occluder, with more noise than elsewhere.
  const std::vector<Vec3> of_occluded = spread(&texels.occlusion_heavy);
  for (std::size_t i = 0; i < squares.size(); ++i)
    squares[i] = texels.occlusion_heavy[i] ? glm::max(of_all[i], of_occluded[i]) : of_all[i];
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
  std::vector<Vec3> noise(n), mean(n), own_variance(n);
  each_texel(context, n, [&](std::size_t i) {
    const Vec3 d = half[0][i] - half[1][i];
    mean[i] = 0.5f * (half[0][i] + half[1][i]);
    noise[i] = 0.5f * d * d;  // variance of one half
    own_variance[i] = 0.25f * d * d;
  });
  const auto pool = [&](std::vector<Vec3> squares, std::vector<Vec3> light) {
    for (std::size_t i = 0; i < n; ++i) light[i] += halves.additional[i];
    return pooled_errors(texels, graph, std::move(squares), light, context);
  };
  // The guide is smoothed a little, so that its noise does not decide on edges.
  std::vector<Vec3> guide = pooled(graph, mean, 1, context);
  std::vector<Vec3> raw_variance = pool(noise, mean);
  noise = pool(std::move(noise), guide);
  std::vector<Vec3> left = halves.common;
  if (!std::ranges::all_of(left, [](const Vec3& square) { return square == Vec3(0); }))
    left = pool(std::move(left), guide);

  Estimate result;
  if (options.strength <= 0 || options.scales <= 0) {
    result.value = mean;
    result.variance = noise;
    for (std::size_t i = 0; i < n; ++i) result.variance[i] = 0.5f * result.variance[i] + glm::max(left[i], Vec3(0));
    return result;
  }
  std::vector<Vec3> guide_variance = noise;
  for (std::size_t i = 0; i < n; ++i) guide_variance[i] *= 0.5f * 3 * remaining_noise(graph.of(i).size());
  // A firefly has noise of its own beyond what its neighbours have.
  for (std::size_t i = 0; i < n; ++i) raw_variance[i] = glm::max(0.5f * raw_variance[i], own_variance[i]);
  const std::vector<Vec3> apart = halves.steps ? guide : deviation_from_neighbours(graph, guide, context);
  const Conductance edges = conductances(texels, graph, {apart, guide_variance, options.strength},
                                         {mean, raw_variance, 1, halves.steps, &own_variance}, context);
  TwoHalves smooth = half;
  smooth_by_scales({graph, edges}, relative_to(texels, guide, halves.additional), options.scales, smooth, context);
  each_texel(context, n, [&](std::size_t i) { guide[i] = 0.5f * (smooth[0][i] + smooth[1][i]); });
  std::vector<Vec3>& of_both = guide_variance;  // noise of the mean of both
  each_texel(context, n, [&](std::size_t i) {
    const Vec3 d = smooth[0][i] - smooth[1][i];
    of_both[i] = 0.25f * d * d;
  });
  of_both = pool(std::move(of_both), guide);

  result.value = std::move(guide), result.variance.resize(n);
  std::vector<Vec3> beyond = beyond_noise(half, smooth, context);
  // Errors are relative to the filtered light, as the requested error is.
  beyond = pool(std::move(beyond), result.value);
  each_texel(context, n, [&](std::size_t i) {
    result.variance[i] = glm::max(beyond[i], of_both[i]);
    result.variance[i] += glm::max(left[i], Vec3(0));
  });
  const double before = total(texels, mean), after = total(texels, result.value);
  result.energy_drift = before > 0 ? after / before - 1 : 0;
  return result;
}

}  // namespace oriel
