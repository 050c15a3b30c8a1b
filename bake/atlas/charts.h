// Automatic charts: connected parts of a surface that lie flat without folds and with little stretch.
#pragma once

#include <vector>

#include "bake/atlas/flatten.h"
#include "bake/atlas/texel_demand.h"
#include "bake/atlas/time_limit.h"
#include "bake/jobs/context.h"
#include "bake/scene/scene.h"

namespace oriel {

struct Chart {
  std::uint32_t first = 0, count = 0;  // into ChartSet::triangles
  DVec2 size{0};                       // metres; wider than high
};

struct ChartSet {
  std::vector<Chart> charts;
  std::vector<std::uint32_t> triangles;  // of the scene, chart by chart
  std::vector<Triangle2> points;         // by entry of `triangles`: metres in the chart, lowest corner (0, 0)
  bool one_texel = false;                // an artist's: all charts have the same texel, along both axes
  double texel_m = 0;                    // asked for; 0: what eyes want
};

struct ChartOptions {
  double texel_m = 0;                   // the scale of what is worth a chart of its own
  double flat_rad = 0, curved_rad = 0;  // AtlasOptions
  double stretch = 1;                   // largest L2 stretch of a chart
  double merged_area_m2 = 0;            // charts are not merged into larger ones
  double large_m2 = 0;                  // curved charts of more area are cut where they leave much of their box empty
  const AtlasTimeLimit* deadline = nullptr;
  const TexelDemand* demand = nullptr;  // no chart spans two of its rings; null: there are none
};

// A triangle of the scene.
inline Triangle3 triangle_corners(const Scene& scene, std::uint32_t triangle) {
  const UVec3& v = scene.triangles[triangle];
  return {DVec3(scene.positions[v.x]), DVec3(scene.positions[v.y]), DVec3(scene.positions[v.z])};
}

// Charts of every triangle of a surface, front sides only: a lightmap serves both sides of a double-sided one.
//  1. Flat regions of at least 64 texels² are charts of their own, exactly to scale. A patch whose surroundings go on
//     smoothly (within 15° along most of its outline) is a part of something curved and is left to 2. So is a strip of
//     at most 4 texels with the shading normals of its neighbours, within the curved angle: a side of a column.
//  2. The rest is grown outwards from its largest triangle, to all whose normals lie within the curved angle of the
//     mean normal that the growths before it found, and across no sharper edge.
//  3. Each region is laid flat (flatten.h). One that would fold, overlap itself or stretch too much is cut across its
//     longest direction, and its parts again, down to single triangles if need be.
//  4. Charts of 2 that adjoin along smooth edges are merged in pairs, those with the largest share of common outline
//     first, as long as the union keeps the same limits (merge.h).
// Once the deadline has passed, what is left of 2 is grown towards the nearest of six directions (the sides of a box),
// and 3 only projects along it: this takes little time and always succeeds.
// Depends on the scene and the options only, unless the deadline passes; incomplete once context.stopped().
ChartSet grow_charts(const Scene& scene, const Surface& surface, const ChartOptions& options, Context& context);

}  // namespace oriel
