// Charts to scale on pages: from metres to texels.
#pragma once

#include "bake/atlas/atlas.h"
#include "bake/atlas/chart/charts.h"
#include "bake/atlas/mask_pack.h"

namespace oriel {

struct LayoutOptions {
  std::uint32_t side = 0, padding = 0;  // of a page, texels
  bool one_page = false;                // of exactly that side, with the finest texel that fits (to half a percent)
  double texel_m = 0;                   // else this one
  std::uint64_t memory_bytes = 0;       // of the lightmap: more texels than fit there are an error; 0: no limit
};

// Bytes of a baked lightmap a page's texel: irradiance and its error in floats, the state, and the part of the
// surface under it.
inline constexpr std::uint64_t kLightmapTexelBytes = 2 * 12 + 1 + 16;

// Puts every chart on a page and writes pages, page, chart, uv, texel_m and the report's stretch of the
// atlas. A chart longer than a page is
// drawn as much coarser as it needs (a warning says so). Errors: kRuntime when no texel size or too few pages suffice,
// or the memory (each says what would).
Status lay_out(const Scene& scene, std::span<const ChartSet> sets, const LayoutOptions& options, Context& context,
               Atlas& atlas);

}  // namespace oriel
