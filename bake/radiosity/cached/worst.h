// Which texels to refine.
#pragma once

#include "bake/radiosity/texels/neighbours.h"

namespace oriel {

struct WorstOptions {
  double goal = 0;    // squared relative error asked for, mean over what is seen
  double excess = 0;  // sum of squared relative errors, each by what is seen of the texel, that is to go
  double gain = 0.5;  // part of a texel's that its refinement takes away
};

// Of `open` (in coherent_order) those, in that order, whose refinement takes the excess away at the least cost: the
// worst first, by what their surroundings tell of them, since texels chosen by their own noisy errors would stop where
// chance made these small. Those twice as good as asked are left alone: they cannot make up for a few that stay bad.
// squares: squared relative error by texel; samples: what it has so far, which doubling costs once more.
std::vector<std::uint32_t> worst_texels(const Texels& texels, const TexelGraph& graph,
                                        std::span<const std::uint32_t> open, const std::vector<float>& squares,
                                        const std::vector<std::uint32_t>& samples, const WorstOptions& options,
                                        Context& context);

}  // namespace oriel
