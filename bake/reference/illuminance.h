// Illuminance at points in space, as a lux meter reads it there, with its error: no lightmap is involved.
#pragma once

#include "bake/jobs/context.h"
#include "bake/reference/points.h"
#include "bake/trace/path.h"

namespace oriel {

struct LuxOptions {
  // Of luminance: standard error over (illuminance + 1 % of the mean over all points). 0: never stop before
  // max_samples.
  double relative_error = 0.01;
  std::uint32_t max_samples = 1u << 22;  // paths a point; rounded down to a power of two, at least 1024
};

// Linear Rec. 709, lux.
struct PointIlluminance {
  DVec3 direct{0};             // straight from lamps and sky, through glass and cut-outs
  DVec3 indirect{0};           // after one reflection or more
  DVec3 standard_error{0};     // of direct + indirect, per channel
  double luminance_error = 0;  // standard error of luminance(direct + indirect)
  std::uint32_t samples = 0;   // paths spent
  bool buried = false;         // the point lies inside a closed body: it meets little but backs of one-sided surfaces
  bool converged = false;      // relative_error was met
};

// One result a point, in order. A point within 2e-6 of the scene's size of a surface is taken to lie on it.
//
// Every estimate is made of 32 independently scrambled Sobol sets whose means give the standard error: the spread
// *within* such a set overstates its error, the spread *between* sets is honest (Owen 1997, randomised quasi-Monte
// Carlo). Sets grow by doubling until the point's own error meets the target. Errors: kStopped.
Result<std::vector<PointIlluminance>> illuminance_at(const Transport& transport, std::span<const MeasurePoint> points,
                                                     const LuxOptions& options, Context& context);

}  // namespace oriel
