// The greedy choice of viewpoints: which few of many candidates show the most, and how sharp is worth its pixels.
#pragma once

#include <span>
#include <vector>

#include "formats/core/archive.h"

namespace oriel {

struct ChoiceOptions {
  std::uint32_t max_maps = 8;
  std::vector<std::uint32_t> resolutions{32, 64, 128, 256, 512, 1024};  // rising: the longer side of a map
};

// What each candidate would need to show each sample sharp: pixels of the longer side, infinite where it does not see
// it.
struct NeedTable {
  std::vector<float> weights;  // of the samples
  std::vector<float> needed;   // candidate c, sample s at c * weights.size() + s
  std::size_t candidates() const { return weights.empty() ? 0 : needed.size() / weights.size(); }
};

inline constexpr double kSeenCounts = 8;              // as much as sharp: a hole is worse than a blur
inline constexpr double kMostGain = kSeenCounts + 1;  // of a sample, of its weight

struct Pick {
  std::uint32_t candidate = 0;
  double gain = 0;             // weight newly seen (kSeenCounts times) and newly sharp
  double seen = 0, sharp = 0;  // shares of the samples' weight, with all picks before it
};
// Maps of one resolution, in the order in which they were picked.
struct Choice {
  std::uint32_t resolution = 0;
  double pixels = 0;  // of one map
  std::vector<Pick> picks;

  double seen() const { return picks.empty() ? 0 : picks.back().seen; }
  double sharp() const { return picks.empty() ? 0 : picks.back().sharp; }
  // Of the picks, less what their pixels cost. price: weight a pixel.
  double value(double price) const;
};

inline void fields(Archive& archive, ChoiceOptions& o) {
  archive(o.max_maps, o.resolutions);
}
inline void fields(Archive& archive, Pick& pick) {
  archive(pick.candidate, pick.gain, pick.seen, pick.sharp);
}
inline void fields(Archive& archive, Choice& c) {
  archive(c.resolution, c.pixels, c.picks);
}

// At one resolution: picks one candidate after the other, each time that with the largest gain, as long as it is more
// than its pixels cost; ties go to the lower number. Greedy choice reaches at least 1 - 1/e of the best one's coverage
// (Nemhauser, Wolsey, Fisher 1978).
Choice choose_views(const NeedTable& table, std::uint32_t max_maps, std::uint32_t resolution, double pixels,
                    double price);

// Of those choices and of their first picks alone, what has the most value; none where none has any.
Choice best_value(std::span<const Choice> choices, double price);

}  // namespace oriel
