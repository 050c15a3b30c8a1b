// The `cached` estimator: bounces live in the lightmap, and one final gather refines them.
#pragma once

#include "bake/radiosity/radiosity.h"

namespace oriel {

// Fills pages (allocated, empty), visible and the report's rays, samples and sweeps. Error kStopped; kInvalid where
// light does not die away.
Status bake_cached(const Transport& transport, const Atlas& atlas, std::span<const TexelMapPage> texel_map,
                   const RadiosityOptions& options, Context& context, std::atomic<std::uint64_t>& rays,
                   Radiosity& result);

}  // namespace oriel
