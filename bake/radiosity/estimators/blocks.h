// Storage of finer cells on a page: their points' light, joined to that of the texels around them.
#pragma once

#include <array>

#include "bake/radiosity/estimators/point_light.h"

namespace oriel {

inline constexpr int kDetailLevels = 3;
static_assert(1u << kDetailLevels == kMostCellSide);

// Fills LightmapPage::cell and detail. The light is continuous: on a side shared with a coarser cell, a finer one shows
// the coarser one's light, and at the centre of a texel whose cells are not all finer, all show the texel. A point
// without its own light (inside a body, or beyond the chart) gets the mean of its neighbours' differences from the
// interpolated texels.
// levels: by place (y * width + x), log2 of a cell's steps. points: by level - 1, the points' light; null: unused. map:
// of the page.
void add_blocks(const TexelMapPage& map, const std::vector<std::uint8_t>& levels, std::uint32_t page_number,
                const std::array<const PointLight*, kDetailLevels>& points, LightmapPage& page);

}  // namespace oriel
