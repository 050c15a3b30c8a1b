// Automatic charts: connected parts of a surface that one projection shows without folds.
#pragma once

#include <vector>

#include "bake/atlas/atlas.h"
#include "bake/atlas/polygon.h"

namespace oriel {

struct Chart {
  std::uint32_t first = 0, count = 0;  // into ChartSet::triangles
  DVec2 size{0};                       // metres; wider than high
};

struct ChartSet {
  std::vector<Chart> charts;
  std::vector<std::uint32_t> triangles;  // of the scene, chart by chart
  std::vector<Triangle2> points;         // by entry of `triangles`: metres in the chart, lowest corner (0, 0)
};

// Charts of every triangle of a surface, front sides only: a lightmap serves both sides of a double-sided one.
//  1. Flat regions of at least 64 texels² are charts of their own, exactly to scale. A patch whose surroundings go on
//     smoothly (within four times the flat angle along most of its outline) is a part of something curved and is left
//     to 2.
//  2. The rest is grown outwards from its largest triangle, to all whose normals lie within the curved angle of the
//     mean normal that the growths before it found, and across no sharper edge; it is projected along its mean normal.
//  3. A chart that overlaps itself when flat is halved in the order of its growth, down to single triangles if need be.
// Deterministic: depends on the scene and the options only; incomplete once context.stopped(). texel_m: metres, the
// scale of 1 and of what overlap matters.
ChartSet grow_charts(const Scene& scene, const Surface& surface, const AtlasOptions& options, double texel_m,
                     const Context& context);

}  // namespace oriel
