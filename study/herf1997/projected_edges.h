// A view's edges as eight light samples see them.
#pragma once

#include <span>

#include "study/herf1997/fixed_edge.h"
#include "study/herf1997/occluder_view.h"
#include "study/herf1997/simd.h"

namespace oriel::study {

inline constexpr int kLanes = 8;

struct EdgeLanes {
  std::array<std::uint64_t, kLanes> x{}, step{};
  std::array<std::int32_t, kLanes> first{}, last{};

  FixedEdge of(int lane) const { return {x[lane], step[lane], first[lane], last[lane]}; }
};

// +1 where a face is seen counter-clockwise (x right, y up), -1 clockwise, 0 edge-on.
using SideLanes = std::array<std::int8_t, kLanes>;

class ProjectedEdges {
 public:
  // Samples first to first + 7 of the view; lanes beyond the last repeat it.
  void project(const OccluderView& view, int first, int height, Simd simd);

  std::vector<EdgeLanes> edges;
  std::vector<SideLanes> sides;
  // By point, for each lane: texels.
  std::vector<std::array<double, kLanes>> x, y;
};

using FaceEdges = std::array<FixedEdge, 3>;

// Faces beside the light, cut for one apex.
std::vector<FaceEdges> edges_beside_light(const OccluderView& view, const DVec3& apex, int height);

}  // namespace oriel::study
