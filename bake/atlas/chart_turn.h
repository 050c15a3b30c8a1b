// How a chart's normals turn over it.
#pragma once

#include "bake/atlas/charts.h"

namespace oriel {

// By how much a chart's normals turn from one end of each of its axes to the other, radians: of the linear function of
// the position that fits them best (least squares over the area), which is less than all where they turn by more than
// half a circle.
DVec2 turn_of(const Scene& scene, const ChartSet& set, const Chart& chart);

}  // namespace oriel
