// The artist's lightmap coordinates: which can be taken, as one page or as charts to pack.
#pragma once

#include "bake/atlas/atlas.h"
#include "bake/atlas/charts.h"

namespace oriel {

struct Uv1Check {
  std::vector<std::uint32_t> own;     // surfaces whose charts are taken
  std::vector<std::uint32_t> faulty;  // the others: they need charts of ours
  bool one_page = false;              // with a resolution: those of `own` lie in [0, 1], apart from each other
};

// Checks surfaces (indices) for taking TEXCOORD_1 as it is, and warns of all that is found. Faulty are those without
// it, those where a triangle has no area there (more than a millionth of the surface), and those of which two triangles
// have a common part thicker than 1/1000 texel and larger than 1e-4 texel² (or a tenth of the smaller one). Also said:
// why they are not one page, charts that lie nearer together than the padding, and coordinates that are far too small.
Uv1Check check_uv1(const Scene& scene, const std::vector<std::uint32_t>& surfaces, const AtlasOptions& options,
                   Context& context);

// A surface's own charts, to one scale: that at which they have the surface's area. A chart is a part connected in
// position and coordinates.
ChartSet own_charts(const Scene& scene, const Surface& surface);

// Puts surfaces on page 0, whose size is set already, as their coordinates say; ids go on from chart_count.
void place_uv1(const Scene& scene, const std::vector<std::uint32_t>& surfaces, Atlas& atlas);

}  // namespace oriel
