// Which edges triangles have in common.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bake/scene/scene.h"

namespace oriel {

// By vertex: the first of those at its position.
std::vector<std::uint32_t> weld(std::span<const Vec3> positions);
// Of a surface: the welded vertex of each corner, three a triangle, counted from its first vertex.
std::vector<std::uint32_t> welded_corners(const Scene& scene, const Surface& surface);

struct EdgeUse {
  std::uint32_t low, high;  // welded vertices
  std::uint32_t corner;     // 3 * triangle + k: the edge from corner k to the next
  bool forward;             // from low to high
  bool same_edge(const EdgeUse& other) const { return low == other.low && high == other.high; }
};

// Of triangles with three different corners. Ascending by low, high, corner.
std::vector<EdgeUse> edge_uses(std::span<const std::uint32_t> corners);

// Calls visit() with all uses of each edge.
template <class Visit>
void for_each_edge(std::span<const EdgeUse> uses, const Visit& visit) {
  for (std::size_t i = 0, end = 0; i < uses.size(); i = end) {
    while (end < uses.size() && uses[end].same_edge(uses[i])) ++end;
    visit(uses.subspan(i, end - i));
  }
}

}  // namespace oriel
