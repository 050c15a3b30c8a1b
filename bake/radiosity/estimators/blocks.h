// Finer cells as a page holds them: points' light joined to the texels' around it.
#pragma once

#include <array>

#include "bake/radiosity/estimators/point_light.h"

namespace oriel {

inline constexpr int kDetailLevels = 5;
static_assert(1u << kDetailLevels == kMostDetail);

// Fills the page's cell and detail. Where a finer cell meets one that is not, their common side shows what the coarser
// one shows, and at a texel's centre where not all cells are finer all show the texel, so that nothing steps. Points
// without light of their own, inside something or beyond the chart, differ from the texels' interpolation by what their
// neighbours do. points: by level - 1, with what level gave; null where no cell has it. map: of the page.
void add_blocks(const TexelMapPage& map, const std::vector<std::uint8_t>& levels, std::uint32_t page_number,
                const std::array<const PointLight*, kDetailLevels>& points, LightmapPage& page);

}  // namespace oriel
