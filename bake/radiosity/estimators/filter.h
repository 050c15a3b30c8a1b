// Smoothing of light over neighbouring texels, with an estimate of the remaining error.
#pragma once

#include <algorithm>

#include "bake/radiosity/estimators/direct_light.h"
#include "bake/radiosity/estimators/radiosity_options.h"
#include "bake/radiosity/gather/gather.h"
#include "bake/radiosity/texels/neighbours.h"

namespace oriel {

// Filtered light by texel with its error, lux and lux².
struct Estimate {
  std::vector<Vec3> value;
  std::vector<Vec3> variance;  // expected squared error: noise, and the measurable bias of the filter
  double energy_drift = 0;     // relative change of Σ area * value by the filter
};

// Two independent estimates of texels' light, which share neither points nor rays, lux.
struct Halves {
  std::array<std::vector<Vec3>, kHalves> light;
  std::vector<Vec3> common;      // squared error common to both halves, by texel, to be pooled
  std::vector<Vec3> additional;  // other light of the texels: errors are relative to the sum
  // True: light may step anywhere, as direct light does at shadow edges. False: only near occluders, as light from all
  // around does. Elsewhere a texel that differs from all its neighbours is then a firefly.
  bool steps = true;
};
Halves halves_of(const HalfSums& sums, Context& context);
// Without what is computed by pixel. gathered: reflected light by texel, lux; errors are relative to all light.
Halves halves_of(const DirectSums& sums, const std::vector<Vec3>& gathered);

// Filters light by conservative diffusion over the graph: a texel gains as much as its neighbour loses, so energy does
// not drift. The conductance between two texels falls with the difference of their light over its noise
// (variance-guided, Rousselle et al. 2012). Scales up to about 25 texels are applied one after the other, each only
// where cross-validation of the halves shows that it reduces the error. The error is measured: each half is filtered
// alone and compared with the other, unfiltered half (E|F_a - b|² = error of F_a + noise of b), and the result is
// pooled over neighbours.
Estimate filter(const Texels& texels, const TexelGraph& graph, const Halves& halves, const FilterOptions& options,
                Context& context);

// Filter options for direct light, whose noise lies in penumbrae no wider than the first scale's kernel.
inline FilterOptions narrow(FilterOptions options) {
  options.scales = std::min(options.scales, 1);
  return options;
}

// The mean luminance of the sum of both over visible texels, lux.
float mean_luminance(const Texels& texels, const std::vector<Vec3>& direct, const std::vector<Vec3>& gathered);

// Directional moments of gathered light, smoothed over each texel's neighbourhood, because a few dozen rays are noisy.
std::vector<Vec4> smoothed_moments(const TexelGraph& graph, const HalfSums& sums, Context& context);

// Averages errors over wide neighbourhoods (about 130 texels); the sum stays. Texels chosen by their own noisy errors
// would stop being refined where chance made the error small. errors: by texel, of one sample.
std::vector<float> typical_errors(const TexelGraph& graph, std::vector<float> errors, Context& context);

// Pools squared errors over each texel's neighbourhood, half of them near (about 33 texels), half wide (130), because
// in a small sample low noise may be chance. Errors are pooled relative to `light`, lux: a dark texel next to bright
// ones gets their relative error, not their absolute one.
std::vector<Vec3> pooled_errors(const Texels& texels, const TexelGraph& graph, std::vector<Vec3> squares,
                                const std::vector<Vec3>& light, Context& context);

}  // namespace oriel
