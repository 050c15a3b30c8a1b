// Filling of texels without light of their own, so that bilinear filtering never reads black at a chart's border.
#pragma once

#include "bake/atlas/texel_map.h"
#include "formats/assets/lightmap.h"

namespace oriel {

// Fills buried texels with the mean of valid neighbours in their chart, spreading inwards. Their state stays kBuried. A
// chart without a valid texel stays black.
void fill_buried(const Atlas& atlas, const TexelMapPage& map, LightmapPage& page);

// Fills empty texels within `texels` steps of a filled one with the mean of their filled neighbours; state kDilated.
void dilate(int texels, LightmapPage& page);

}  // namespace oriel
