// Smoothing of light over neighbouring texels, and what is known of its error.
#pragma once

#include <algorithm>

#include "bake/radiosity/estimators/direct_light.h"
#include "bake/radiosity/estimators/radiosity_options.h"
#include "bake/radiosity/gather/gather.h"
#include "bake/radiosity/texels/neighbours.h"

namespace oriel {

// Light per texel with its error, lux.
struct Estimate {
  std::vector<Vec3> value;
  std::vector<Vec3> variance;  // squared error to be expected: noise, and bias of the filter as far as it shows
  double energy_drift = 0;     // relative change of Σ area * value by the filter
};

// Two estimates of the light of texels that share neither points nor rays, lux.
struct Halves {
  std::array<std::vector<Vec3>, kHalves> light;
  std::vector<Vec3> common;  // squared error of both by texel, to be pooled: no difference of theirs tells it
  std::vector<Vec3> beside;  // other light that is there: errors are pooled relative to both
  // Whether it steps in the open, as direct light's shadows do. Light from all around steps at contacts alone:
  // elsewhere a texel that differs from all beside it is one lucky path.
  bool steps = true;
};
Halves halves_of(const HalfSums& sums, Context& context);
// gathered: light beside it. Relative to direct light alone the noise of a shadow would count as much beside it.
Halves halves_of(const DirectSums& sums, const std::vector<Vec3>& gathered);

// A conservative diffusion over the graph: what one texel gains its neighbour loses, so no energy drifts. Conductance
// between two texels falls with the difference of their light over its noise (variance-guided, Rousselle et al. 2012).
// It goes on from scale to scale, up to some 25 texels, and at each only where cross-validation of the two halves tells
// that the light comes nearer to the truth. The error is measured, not modelled: each half is filtered alone and
// compared with the other, unfiltered (E|F_a - b|² = error of F_a + noise of b), pooled over neighbours.
Estimate filter(const Texels& texels, const TexelGraph& graph, const Halves& halves, const FilterOptions& options,
                Context& context);

// Of direct light: its noise lies in penumbrae, which are no wider than the first scale's kernel.
inline FilterOptions narrow(FilterOptions options) {
  options.scales = std::min(options.scales, 1);
  return options;
}

// Of the sum of both, over texels that see light, lux.
float mean_luminance(const Texels& texels, const std::vector<Vec3>& direct, const std::vector<Vec3>& gathered);

// Where gathered light comes from, smoothed over each texel's surroundings: a few dozen rays tell it poorly.
std::vector<Vec4> smoothed_moments(const TexelGraph& graph, const HalfSums& sums, Context& context);

// Refinement that chose texels by their own noisy errors would stop where chance made them small, and state them too
// small: it goes by wide surroundings (about 130 texels). `errors` of one sample. Their sum stays.
std::vector<float> typical_errors(const TexelGraph& graph, std::vector<float> errors, Context& context);

// Squared errors pooled over each texel's surroundings, half of them near (about 33 texels), half wide (130): in a
// small sample a quiet place may be luck. Relative to its light: a dark texel beside bright ones has their relative
// error, not their absolute one. `light`: lux.
std::vector<Vec3> pooled_errors(const Texels& texels, const TexelGraph& graph, std::vector<Vec3> squares,
                                const std::vector<Vec3>& light, Context& context);

}  // namespace oriel
