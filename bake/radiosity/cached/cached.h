// The `cached` estimator: bounces live in the lightmap, and one final gather refines them.
#pragma once

#include "bake/radiosity/radiosity.h"

namespace oriel {

// Asked when the estimate stands in the result: the error that it is to be refined to instead, or 0 to leave it.
using NextError = std::function<Result<double>()>;

// Fills pages (empty ones of the texel map's sizes, each time anew), visible and the report's samples and sweeps, until
// `next` says that it is enough. Error kStopped; kInvalid where light does not die away.
Status bake_cached(const Transport& transport, const Atlas& atlas, std::span<const TexelMapPage> texel_map,
                   const RadiosityOptions& options, Context& context, std::atomic<std::uint64_t>& rays,
                   Radiosity& result, const NextError& next);

}  // namespace oriel
