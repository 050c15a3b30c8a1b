// Charts to scale on pages: from metres to texels.
#pragma once

#include "bake/atlas/atlas.h"
#include "bake/atlas/charts.h"
#include "bake/atlas/mask_pack.h"

namespace oriel {

struct LayoutOptions {
  std::uint32_t side = 0, padding = 0;  // of a page, texels
  bool one_page = false;                // of exactly that side, with the finest texel that fits (to half a percent)
  double texel_m = 0;                   // else this one
  std::uint64_t memory_bytes = 0;       // of baking: more texels than fit there are an error; 0: no limit
  bool coarsen = false;                 // instead of that error, larger texels where least is seen
  std::uint64_t texels_in_time = 0;     // with coarsen: about so many at most; 0: no limit
  const TexelDemand* demand = nullptr;  // charts have texels of their own, never finer than texel_m; null: all the same
};

// Bytes that a bake is taken to need at its peak for a covered texel: points, neighbours, links of bounces, sums of
// both halves. An estimate, from one bake of 30 million texels that took 24 GB.
inline constexpr std::uint64_t kBakeTexelBytes = 800;

// Puts every chart on a page and writes pages, page, chart, uv, texel_m and the report's stretch of the
// atlas. A chart longer than a page is
// drawn as much coarser as it needs (a warning says so). Errors: kRuntime when no texel size or too few pages suffice,
// or the memory (each says what would).
Status lay_out(const Scene& scene, std::span<const ChartSet> sets, const LayoutOptions& options, Context& context,
               Atlas& atlas);

void report_stretch(const StretchSum& sum, AtlasReport& report);

}  // namespace oriel
