// Least-squares stitching of lightmap seams.
#pragma once

#include "bake/radiosity/radiosity.h"
#include "bake/radiosity/seams.h"

namespace oriel {

// Moves the texels that bilinear filtering reads along the seams so that both sides show the same light there. Least
// squares over the points of the seams and those texels (Iwanicki 2013, "Lighting Technology of The Last of Us";
// Sylvan 2010, "Fixing Seams in Lightmaps"): Σ (step / light / kStep)² + Σ (change / light / error)². All is relative
// to the light of the place, so that dark places are treated as bright ones. A texel's error is the standard error
// around it; what of it has no surface is free, being an extrapolation. No channel of a texel moves by more than its
// standard error or a third of its light (what is more), and of its light 3 % and up to two fifths for what has no
// surface. All together they move by no more than at_most, relative to their light (and 1 % of the mean), root mean
// square over all surfaces: charts of a texel or two cannot meet all the light along their outline, and what is mended
// there is an error elsewhere. The result is finite and not negative; empty texels are neither read nor changed.
// `pages` are filled and dilated. SeamReport::energy_change is the caller's.
SeamReport stitch(const Seams& seams, std::span<const TexelMapPage> texel_map, double at_most,
                  std::vector<LightmapPage>& pages);

}  // namespace oriel
