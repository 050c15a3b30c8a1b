// Texel values whose interpolation has the texels' light.
#pragma once

#include <span>

#include "bake/atlas/texel_map.h"
#include "formats/assets/lightmap.h"

namespace oriel {

// An estimate's texels hold the mean light of their squares. Shown by bilinear interpolation that is smoothed a second
// time: where light bends (the border of a penumbra, the foot of a wall) pixels are off by what a texel's mean differs
// from what interpolation has there on average, an eighth of the second difference along each axis. Values are sought
// whose interpolation has the means again, B c = a with B = [1 6 1]/8 along each axis, by iteration c += a - B c
// (Landweber), each within the means around it, so that an edge does not ring. It goes as far as it tells from noise: a
// change d is weighted d² / (d² + (2 σ)²), σ the standard error (Wiener). Neighbours are of the same chart and valid;
// texels without a whole square of surface stay. The sum over a chart stays within noise and bounds. Standard errors
// stay: they are of the means. All valid texels are finite and not negative if they were.
// groups: pages with the light of groups of lamps, which sum to the page's: fitted as far as it is.
void fit_texels(const Atlas& atlas, const TexelMapPage& map, LightmapPage& page,
                std::span<LightmapPage* const> groups = {});

}  // namespace oriel
