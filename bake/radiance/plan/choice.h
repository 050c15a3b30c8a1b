// The greedy choice of viewpoints: which few of many candidates show the most.
#pragma once

#include <span>
#include <vector>

#include "formats/core/archive.h"

namespace oriel {

struct ChoiceOptions {
  std::uint32_t max_maps = 8;
  std::vector<std::uint32_t> resolutions{64, 128, 256, 512, 1024};  // rising: the longer side of a map
  // Where both are reached no more is added: a little over what is promised, for eyes that planning has not met.
  double seen = 0.9995, sharp = 0.985;
};

inline void fields(Archive& archive, ChoiceOptions& o) {
  archive(o.max_maps, o.resolutions, o.seen, o.sharp);
}

// What each candidate would need to show each sample sharp: pixels of the longer side, infinite where it does not see
// it.
struct NeedTable {
  std::vector<float> weights;  // of the samples
  std::vector<float> needed;   // candidate c, sample s at c * weights.size() + s
  std::size_t candidates() const { return weights.empty() ? 0 : needed.size() / weights.size(); }
};

struct Pick {
  std::uint32_t candidate = 0;
  double gain = 0;  // weight newly seen and newly sharp
};
struct Choice {
  std::uint32_t resolution = 0;
  std::vector<Pick> picks;
  double seen = 0, sharp = 0;  // shares of the samples' weight
};

inline void fields(Archive& archive, Pick& pick) {
  archive(pick.candidate, pick.gain);
}
inline void fields(Archive& archive, Choice& c) {
  archive(c.resolution, c.picks, c.seen, c.sharp);
}

// Picks one candidate after the other, each time that with the largest weight of samples newly seen (counted eight
// times) and newly sharp; ties go to the lower number. Greedy choice reaches at least 1 - 1/e of the best one's
// coverage (Nemhauser, Wolsey, Fisher 1978). Of the resolutions, the one that reaches the targets with the fewest
// pixels; where none does, the one that comes closest.
Choice choose_views(const NeedTable& table, const ChoiceOptions& options);

}  // namespace oriel
