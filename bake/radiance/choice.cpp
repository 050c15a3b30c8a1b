#include "bake/radiance/choice.h"

#include <algorithm>
#include <limits>
#include <queue>

namespace oriel {
namespace {

constexpr float kNever = std::numeric_limits<float>::infinity();

}  // namespace

double Choice::value(double price) const {
  double sum = 0;
  for (const Pick& pick : picks) sum += pick.gain - price * pixels;
  return sum;
}

Choice choose_views(const NeedTable& table, std::uint32_t max_maps, std::uint32_t resolution, double pixels,
                    double price) {
  const std::size_t n = table.weights.size();
  const auto limit = static_cast<float>(resolution);
  std::vector<std::uint8_t> state(n);  // 1: seen, 2: sharp
  const auto gain_of = [&](std::uint32_t c) {
    double gain = 0;
    const float* needed = &table.needed[c * n];
    for (std::size_t s = 0; s < n; ++s) {
      if (needed[s] == kNever) continue;
      gain += table.weights[s] * ((state[s] == 0 ? kSeenCounts : 0) + (state[s] < 2 && needed[s] <= limit ? 1 : 0));
    }
    return gain;
  };
  // Gains only fall while others are picked: one that was found earlier is a bound (Minoux 1978).
  struct Bound {
    double gain;
    std::uint32_t candidate;
    std::size_t found_at;  // with so many picked
    bool operator<(const Bound& b) const { return gain != b.gain ? gain < b.gain : candidate > b.candidate; }
  };
  std::vector<Bound> bounds;
  for (std::uint32_t c = 0; c < table.candidates(); ++c) bounds.push_back({gain_of(c), c, 0});
  std::priority_queue<Bound> queue(std::less<Bound>(), std::move(bounds));

  double total = 0, seen = 0, sharp = 0;
  for (const float w : table.weights) total += w;
  Choice choice{resolution, pixels, {}};
  while (choice.picks.size() < max_maps && !queue.empty() && queue.top().gain > price * pixels) {
    const Bound best = queue.top();
    queue.pop();
    if (best.found_at < choice.picks.size()) {
      queue.push({gain_of(best.candidate), best.candidate, choice.picks.size()});
      continue;
    }
    const float* needed = &table.needed[best.candidate * n];
    for (std::size_t s = 0; s < n; ++s) {
      if (needed[s] == kNever) continue;
      const std::uint8_t now = needed[s] <= limit ? 2 : 1;
      if (state[s] == 0) seen += table.weights[s];
      if (state[s] < 2 && now == 2) sharp += table.weights[s];
      state[s] = std::max(state[s], now);
    }
    choice.picks.push_back({best.candidate, best.gain, seen / total, sharp / total});
  }
  return choice;
}

Choice best_value(std::span<const Choice> choices, double price) {
  const Choice* best = nullptr;
  std::size_t count = 0;
  double most = 0;
  for (const Choice& choice : choices) {
    double value = 0;
    for (std::size_t i = 0; i < choice.picks.size(); ++i) {
      value += choice.picks[i].gain - price * choice.pixels;
      if (value > most) best = &choice, count = i + 1, most = value;
    }
  }
  if (!best) return {};
  Choice chosen = *best;
  chosen.picks.resize(count);
  return chosen;
}

}  // namespace oriel
