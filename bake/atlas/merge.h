// Fewer, larger charts.
#pragma once

#include <functional>

#include "bake/atlas/flatten.h"
#include "bake/jobs/context.h"

namespace oriel {

// No chart has more triangles: a conformal map's memory grows faster than their number.
inline constexpr std::size_t kMaxChartFaces = 65536;

struct GrownChart {
  FlatChart flat;
  bool exact = false;  // a flat region: kept as it is
};

// What merging must know of a surface. All by face, or by edge (3 * face + corner).
struct MergeSurface {
  std::span<const std::uint32_t> across;
  std::function<Triangle3(std::uint32_t face)> corners;
  // Cosine of the angle between two faces' normals; 1 where one has none.
  std::function<double(std::uint32_t face, std::uint32_t other)> cosine;
  double smooth_cos = 0;          // of the sharpest edge within a chart
  double tiny_area = 0;           // m²: a chart of less area may join one beyond a sharper edge
  std::function<bool()> expired;  // the deadline has passed
  double largest_area = 0;        // of a merged chart, m²
};

// Merges charts that are not exact. In each round charts are grouped: one and a neighbour, or one and many much smaller
// ones, those first whose common smooth outline is the largest share of the shorter of their outlines (for tiny charts,
// edges of up to 75° count as smooth); all groups are tried at once. A pair that cannot be laid flat within the limits
// is not tried again. All rounds together lay flat at most sixteen times as many triangles as the surface has: the work
// is nearly proportional to its size. Independent of the number of threads.
void merge_charts(const MergeSurface& surface, const FlattenLimits& limits, Context& context,
                  std::vector<GrownChart>& charts);

}  // namespace oriel
