// Least-squares stitching of lightmap seams.
#pragma once

#include "bake/radiosity/radiosity.h"
#include "bake/radiosity/seams.h"

namespace oriel {

// Changes the texels that bilinear filtering reads along seams so that both sides show the same light there: a
// least-squares problem over the seam points and those texels (Iwanicki 2013, "Lighting Technology of The Last of Us";
// Sylvan 2010, "Fixing Seams in Lightmaps"), Σ (step / light / kStep)² + Σ (change / light / error)². Both terms are
// relative to the local light, so that dark places are treated like bright ones. A texel's error is the standard error
// around it; the fraction of a texel without surface is free, as it is an extrapolation.
//
// Limits: no channel of a texel changes by more than its standard error or a third of its light, whichever is larger,
// plus 3 % of its light, plus up to two fifths for the fraction without surface. The rms change over all surfaces,
// relative to light (and 1 % of the mean), is at most `at_most`: charts of a texel or two cannot match all the light
// along their outline, and a mended seam would be an error elsewhere. The result is finite and not negative. Empty
// texels are neither read nor changed. pages: filled and dilated. The caller sets SeamReport::energy_change.
//
// left_s: seconds that there are; empty: no limit. Where a solution would take longer, nothing is changed.
SeamReport stitch(const Seams& seams, std::span<const TexelMapPage> texel_map, double at_most,
                  std::vector<LightmapPage>& pages, const std::function<double()>& left_s = {});

}  // namespace oriel
