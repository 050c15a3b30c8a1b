#include "bake/radiosity/estimators/part.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace oriel {
namespace {

// Of a part's squared error, so much is to go with each refinement: less would take long, more would leave the other
// part no turn.
constexpr double kLeastAtOnce = 0.1, kMostAtOnce = 0.5;
constexpr double kNoisiest = 0.64;         // texel: of one gathered ray, relative, after the filter
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

void Part::measure(std::span<const std::uint32_t> texels, const std::vector<float>& importance) {
  mean = stuck = 0;
  double share = 0, all = 0, all_stuck = 0;
  for (const std::uint32_t i : texels) {
    share += importance[i], mean += squares[i], all += samples[i];
    if (samples[i] >= most) stuck += squares[i], all_stuck += samples[i];
  }
  if (share > 0) mean /= share, stuck /= share;
  open_rays = all > 0 ? rays * (1 - all_stuck / all) : rays;
}

std::vector<std::uint32_t> worst_of(const TexelGraph& graph, std::vector<std::uint32_t> texels, const Part& part,
                                    const FrameGoal& goal, Context& context) {
  double seen = 0;
  for (const std::uint32_t i : texels) seen += goal.importance[i];
  std::erase_if(texels, [&](std::uint32_t i) { return part.samples[i] >= part.most; });
  const double excess = std::clamp(goal.now - goal.asked, kLeastAtOnce * part.open(), kMostAtOnce * part.open());
  return worst_texels(graph, texels, {part.squares, goal.importance, part.samples},
                      {.goal = goal.asked * part.open() / goal.now, .excess = excess * seen, .gain = part.gain},
                      context);
}

}  // namespace oriel
