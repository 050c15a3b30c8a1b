// The `cached` estimator: bounces live in the lightmap, and one final gather refines them.
#pragma once

#include "bake/radiosity/frames/frame_pixels.h"
#include "bake/radiosity/radiosity.h"

namespace oriel {

// What is to be done about an estimate.
struct Refinement {
  double error = 0;     // that the noise is to be brought to; 0: nothing
  bool nearer = false;  // and what surfaces nearby reflect is to be followed from further away: four times as far
};

// Asked when the estimate stands in the result.
using NextRefinement = std::function<Result<Refinement>()>;

// Effort goes where `pixels` look. Fills pages (empty ones of the texel map's sizes, each time anew), visible and the
// report's samples and sweeps, until `next` says that it is enough. Error kStopped; kInvalid where light does not die
// away.
Status bake_cached(const Transport& transport, const Atlas& atlas, std::span<const TexelMapPage> texel_map,
                   std::span<const FramePixel> pixels, const RadiosityOptions& options, Context& context,
                   std::atomic<std::uint64_t>& rays, Radiosity& result, const NextRefinement& next);

}  // namespace oriel
