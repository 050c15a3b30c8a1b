#include "bake/radiosity/estimators/light_component.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace oriel {
namespace {

// Bounds on the fraction of a component's squared error that one refinement removes: less would be slow, more would
// starve the other component.
constexpr double kLeastAtOnce = 0.1, kMostAtOnce = 0.5;
constexpr double kNoisiest = 0.64;         // relative error of one gather ray of a noisy texel, after the filter
constexpr std::uint32_t kLeastMost = 256;  // rays

}  // namespace

MostRays::MostRays(const RadiosityOptions& options) : most_(options.samples), last_(options.samples) {
  if (options.error <= 0) return;
  const double wanted = std::min(1e6, std::pow(kNoisiest / std::max(options.error, 1e-6), 2));
  most_ = std::min(last_, std::bit_ceil(std::max(static_cast<std::uint32_t>(wanted), kLeastMost)));
}

bool MostRays::raise() {
  if (most_ >= last_) return false;
  most_ = std::min(2 * most_, last_);
  return true;
}

void LightComponent::measure(std::span<const std::uint32_t> texels, const std::vector<float>& importance) {
  mean = converged = 0;
  double share = 0, all = 0, all_converged = 0;
  for (const std::uint32_t i : texels) {
    share += importance[i], mean += squares[i], all += samples[i];
    if (samples[i] >= max_samples) converged += squares[i], all_converged += samples[i];
  }
  if (share > 0) mean /= share, converged /= share;
  refinable_rays = all > 0 ? rays * (1 - all_converged / all) : rays;
}

std::vector<std::uint32_t> worst_of(const TexelGraph& graph, std::vector<std::uint32_t> texels,
                                    const LightComponent& component, const FrameGoal& goal, Context& context) {
  double seen = 0;
  for (const std::uint32_t i : texels) seen += goal.importance[i];
  std::erase_if(texels, [&](std::uint32_t i) { return component.samples[i] >= component.max_samples; });
  const double excess =
      std::clamp(goal.now - goal.asked, kLeastAtOnce * component.refinable(), kMostAtOnce * component.refinable());
  return worst_texels(
      graph, texels, {component.squares, goal.importance, component.samples},
      {.goal = goal.asked * component.refinable() / goal.now, .excess = excess * seen, .gain = component.gain},
      context);
}

}  // namespace oriel
