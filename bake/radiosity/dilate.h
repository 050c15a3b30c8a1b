// Filling of texels that no light was baked for, so that bilinear filtering never reads black beside a chart.
#pragma once

#include "bake/atlas/texel_map.h"
#include "formats/assets/lightmap.h"

namespace oriel {

// Buried texels take the mean of their chart's valid neighbours, spreading inwards; their state stays kBuried. A chart
// that is buried whole stays black.
void fill_buried(const Atlas& atlas, const TexelMapPage& map, LightmapPage& page);

// Empty texels within `texels` steps of a filled one take the mean of their filled neighbours and become kDilated.
void dilate(int texels, LightmapPage& page);

}  // namespace oriel
