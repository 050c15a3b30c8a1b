// Whether a bake holds: unbiased paths from texels that it did not know would be asked.
#pragma once

#include "bake/radiosity/radiosity.h"

namespace oriel {

// Held-out texels, spread evenly over the surfaces (systematic sampling of the texels by surface), are estimated anew
// by paths with random numbers of their own. Each gets two independent estimates a and b: (baked - a)(baked - b) is the
// squared error with no noise of theirs in its mean, however long the tails of the paths are. Noisy texels get more
// paths, as a few paths of their own foretell. More texels are asked until the squared error is known to a fifth of
// what was asked for, or `rays_at_most` are traced; at least 64 are. Nothing depends on threads or the clock. Stage
// name "certificate"; error kStopped.
Result<Certificate> certify(const Transport& transport, const Atlas& atlas, std::span<const TexelMapPage> texel_map,
                            const Radiosity& radiosity, double asked, std::uint64_t rays_at_most, Context& context);

}  // namespace oriel
