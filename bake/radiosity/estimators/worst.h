// Choice of the texels to refine.
#pragma once

#include "bake/radiosity/texels/neighbours.h"

namespace oriel {

struct WorstOptions {
  double goal = 0;    // mean square requested
  double excess = 0;  // mean square to be removed
  double gain = 0.5;  // fraction of a texel's square that its refinement removes
};

// Errors by texel.
struct TexelErrors {
  const std::vector<float>& squares;          // contribution to the mean square
  const std::vector<float>& importance;       // fraction of the frame pixels, averaged over the neighbourhood
  const std::vector<std::uint32_t>& samples;  // so far; doubling them costs as many again
};

// Chooses from `candidates` (in coherent_order) texels whose refinement removes options.excess at the least cost, and
// returns them in that order. The worst come first, by errors averaged over their neighbourhood (typical_errors): their
// own noisy errors would stop refinement where chance made them small, and would miss texels between the frame pixels.
// Texels twice as good as the goal are left out: they cannot make up for a few bad ones.
std::vector<std::uint32_t> worst_texels(const TexelGraph& graph, std::span<const std::uint32_t> candidates,
                                        const TexelErrors& of, const WorstOptions& options, Context& context);

// Texels with the same number of samples.
struct SameSamples {
  std::uint32_t samples = 0;
  std::vector<std::uint32_t> texels;
};
// Groups a list by number of samples; each group keeps the list's order. samples: by texel.
std::vector<SameSamples> groups_of(std::span<const std::uint32_t> list, const std::vector<std::uint32_t>& samples);

// Marks the texels of least importance (true): all together they would add no more than `square` to the mean
// square if their light were all wrong. Coarser patches with their own rays carry the bounces, so these texels get a
// few rays each. None for square 0, where no error is requested.
std::vector<bool> little_seen(std::span<const std::uint32_t> texels, const std::vector<float>& importance,
                              double square);

}  // namespace oriel
