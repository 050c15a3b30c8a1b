#include "bake/atlas/chart_ends.h"

#include <algorithm>

#include "bake/atlas/charts.h"
#include "bake/scene/box_tree.h"

namespace oriel {
namespace {

// Cuts the surface where one ring ends and the next begins.
void part_rings(const TexelDemand& demand, std::uint32_t first, std::vector<std::uint32_t>& across) {
  for (std::uint32_t edge = 0; edge < across.size(); ++edge)
    if (across[edge] != kNoEdge && demand.ring(first + edge / 3) != demand.ring(first + across[edge] / 3))
      across[across[edge]] = kNoEdge, across[edge] = kNoEdge;
}

double distance_to(const ChartCut& cut, const DVec3& p) {
  const DVec3 from(cut.from), along = DVec3(cut.to) - from;
  return glm::distance(p, from + std::clamp(glm::dot(p - from, along) / glm::dot(along, along), 0.0, 1.0) * along);
}

// Cuts the surface under walls.
void part_rooms(const Scene& scene, const Surface& surface, std::vector<std::uint32_t>& across) {
  TreeBox all;
  for (std::uint32_t v = 0; v < surface.vertex_count; ++v) all.add(DVec3(scene.positions[surface.first_vertex + v]));
  std::vector<ChartCut> cuts;
  for (const ChartCut& cut : scene.cuts)
    if (glm::all(glm::lessThan(DVec3(glm::min(cut.from, cut.to)), all.upper + cut.tolerance_m())) &&
        glm::all(glm::greaterThan(DVec3(glm::max(cut.from, cut.to)), all.lower - cut.tolerance_m())))
      cuts.push_back(cut);
  if (cuts.empty()) return;
  const BoxTree tree = tree_of(cuts);
  std::vector<std::uint32_t> near;
  for (std::uint32_t edge = 0; edge < across.size(); ++edge) {
    if (across[edge] == kNoEdge) continue;
    const Triangle3 t = triangle_corners(scene, surface.first_triangle + edge / 3);
    const DVec3 a = t[edge % 3], b = t[(edge + 1) % 3];
    tree.near({glm::min(a, b), glm::max(a, b)}, near);
    const auto on = [&](std::uint32_t i) {
      return std::max(distance_to(cuts[i], a), distance_to(cuts[i], b)) < cuts[i].tolerance_m();
    };
    if (std::ranges::any_of(near, on)) across[across[edge]] = kNoEdge, across[edge] = kNoEdge;
  }
}

}  // namespace

void end_charts(const Scene& scene, const Surface& surface, const TexelDemand* demand,
                std::vector<std::uint32_t>& across) {
  if (demand != nullptr) part_rings(*demand, surface.first_triangle, across);
  part_rooms(scene, surface, across);
}

}  // namespace oriel
