// Whether a bake holds: unbiased paths from texels that it did not know would be asked.
#pragma once

#include <array>

#include "bake/radiosity/radiosity.h"

namespace oriel {

inline constexpr std::size_t kEstimates = 3;

// Squared error of a texel relative to its light, mean over channels, by independent unbiased estimates: (baked - a)
// (baked - b) has no noise of theirs in its mean, however long the tails of the paths are; what it is divided by, the
// square of the brighter of texel and third estimate plus floor2, must not know a and b either: where paths seldom find
// a light, most of a and b are 0, and divided by what they found the few that found it would weigh too little. Each
// estimate is the divisor once. lux.
double squared_error(const DVec3& baked, const std::array<DVec3, kEstimates>& estimates, const DVec3& floor2);

// Held-out texels, spread evenly over what is seen of surfaces (systematic sampling by surface; seen_share()), are
// estimated anew by paths with random numbers of their own, thrice each (squared_error). Noisy texels get more paths,
// as a few paths of their own foretell. More texels are asked until the squared error is known to a fifth of what was
// asked for, or `rays_at_most` are traced; at least 64 are. Nothing depends on threads or the clock. Stage name
// "certificate"; error kStopped.
Result<Certificate> certify(const Transport& transport, const Atlas& atlas, std::span<const TexelMapPage> texel_map,
                            const Radiosity& radiosity, double asked, std::uint64_t rays_at_most, Context& context);

}  // namespace oriel
