#include "bake/radiance/plan/choice.h"

#include <algorithm>
#include <limits>

namespace oriel {
namespace {

constexpr double kSeenCounts = 8;       // as much as sharp: a hole is worse than a blur
constexpr double kLeastGain = 1e-4;     // of all weight: what is not worth a map
constexpr double kCloseEnough = 0.005;  // in a share of samples: fewer pixels are preferred

Choice choose_at(const NeedTable& table, const ChoiceOptions& options, std::uint32_t resolution) {
  const std::size_t n = table.weights.size();
  const auto limit = static_cast<float>(resolution);
  std::vector<std::uint8_t> state(n);  // 1: seen, 2: sharp
  double total = 0, seen = 0, sharp = 0;
  for (const float w : table.weights) total += w;
  Choice choice{resolution, {}, 0, 0};
  while (choice.picks.size() < options.max_maps && (seen < options.seen * total || sharp < options.sharp * total)) {
    Pick best;
    for (std::uint32_t c = 0; c < table.candidates(); ++c) {
      double gain = 0;
      const float* needed = &table.needed[c * n];
      for (std::size_t s = 0; s < n; ++s) {
        if (needed[s] == std::numeric_limits<float>::infinity()) continue;
        gain += table.weights[s] * ((state[s] == 0 ? kSeenCounts : 0) + (state[s] < 2 && needed[s] <= limit ? 1 : 0));
      }
      if (gain > best.gain) best = {c, gain};
    }
    if (!(best.gain > kLeastGain * total)) break;
    const float* needed = &table.needed[best.candidate * n];
    for (std::size_t s = 0; s < n; ++s) {
      if (needed[s] == std::numeric_limits<float>::infinity()) continue;
      const std::uint8_t now = needed[s] <= limit ? 2 : 1;
      if (state[s] == 0) seen += table.weights[s];
      if (state[s] < 2 && now == 2) sharp += table.weights[s];
      state[s] = std::max(state[s], now);
    }
    choice.picks.push_back(best);
  }
  choice.seen = total > 0 ? seen / total : 0;
  choice.sharp = total > 0 ? sharp / total : 0;
  return choice;
}

double pixels(const Choice& choice) {
  return static_cast<double>(choice.picks.size()) * choice.resolution * choice.resolution;
}

}  // namespace

Choice choose_views(const NeedTable& table, const ChoiceOptions& options) {
  std::vector<Choice> choices;
  double most_seen = 0;
  for (const std::uint32_t resolution : options.resolutions) {
    choices.push_back(choose_at(table, options, resolution));
    most_seen = std::max(most_seen, choices.back().seen);
  }
  // What no choice reaches must not make every resolution fail.
  const double seen = std::min(options.seen, most_seen - kCloseEnough);
  const auto reaches = [&](const Choice& c) { return c.seen >= seen && c.sharp >= options.sharp; };
  Choice best;
  for (Choice& choice : choices) {
    const bool better =
        best.picks.empty() || (reaches(best) ? reaches(choice) && pixels(choice) < pixels(best)
                                             : reaches(choice) || choice.sharp > best.sharp + kCloseEnough);
    if (better) best = std::move(choice);
  }
  return best;
}

}  // namespace oriel
