// Which texels to refine.
#pragma once

#include "bake/radiosity/texels/neighbours.h"

namespace oriel {

struct WorstOptions {
  double goal = 0;    // mean square asked for
  double excess = 0;  // of it that is to go
  double gain = 0.5;  // part of a texel's that its refinement takes away
};

// By texel.
struct TexelErrors {
  const std::vector<float>& squares;          // its part of the mean square
  const std::vector<float>& importance;  // of frames that it fills, as its surroundings tell
  const std::vector<std::uint32_t>& samples;  // what it has so far, which doubling costs once more
};

// Of `open` (in coherent_order) those, in that order, whose refinement takes the excess away at the least cost: the
// worst first, by what their surroundings tell of them, since texels chosen by their own noisy errors would stop where
// chance made these small, and those between the pixels that tell of errors would be forgotten. Those twice as good as
// asked are left alone: they cannot make up for a few that stay bad.
std::vector<std::uint32_t> worst_texels(const TexelGraph& graph, std::span<const std::uint32_t> open,
                                        const TexelErrors& of, const WorstOptions& options, Context& context);

// Texels that have the same number of samples.
struct SameSamples {
  std::uint32_t samples = 0;
  std::vector<std::uint32_t> texels;
};
// In the list's order, each. samples: by texel.
std::vector<SameSamples> groups_of(std::span<const std::uint32_t> list, const std::vector<std::uint32_t>& samples);

// Of `texels` those that fill the least of frames, which together would add no more than `square` to the mean square
// were all their light wrong. By texel. Bounces are carried by coarser patches with rays of their own: what these
// texels get beside it are a few rays each. None where no error is asked for (square 0).
std::vector<bool> little_seen(std::span<const std::uint32_t> texels, const std::vector<float>& importance,
                              double square);

}  // namespace oriel
