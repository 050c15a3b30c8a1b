// The artist's lightmap coordinates: checked, and taken as they are.
#pragma once

#include "bake/atlas/atlas.h"

namespace oriel {

// Puts the given surfaces (indices; each has_uv1) on page 0 of the atlas, whose size is set already. A chart is a
// part connected in position and coordinates; ids are counted on from atlas.chart_count.
// Checks, in texels of that page: every corner in [0, 1] give or take 1e-6 (then clamped); no triangle without area,
// unless those make up less than a millionth of their surface (a warning then); no two triangles with a common part
// thicker than 1/1000 texel and larger than 1e-4 texel² (or a tenth of the smaller one). Else kInvalid, naming the
// meshes.
Status place_uv1(const Scene& scene, const std::vector<std::uint32_t>& surfaces, Context& context, Atlas& atlas);

}  // namespace oriel
