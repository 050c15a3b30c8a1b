// The certificate: unbiased paths from random texels beside what was baked.
#pragma once

#include "bake/radiosity/radiosity.h"

namespace oriel {

// A share of the bake's own rays goes into it, spread over random valid texels. Other random numbers than the bake's.
// Stage name "certificate"; error kStopped.
Result<Certificate> certify(const Transport& transport, const Atlas& atlas, std::span<const TexelMapPage> texel_map,
                            const Radiosity& radiosity, std::uint64_t rays_of_bake, Context& context);

}  // namespace oriel
