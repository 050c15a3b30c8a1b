#include "bake/atlas/chart_ends.h"

#include <algorithm>

#include "bake/atlas/charts.h"

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
  if (scene.cuts.empty()) return;
  DVec3 lower(std::numeric_limits<double>::max()), upper(-lower);
  for (std::uint32_t v = 0; v < surface.vertex_count; ++v) {
    const DVec3 p(scene.positions[surface.first_vertex + v]);
    lower = glm::min(lower, p - kCutTolerance_m), upper = glm::max(upper, p + kCutTolerance_m);
  }
  std::vector<ChartCut> near;
  for (const ChartCut& cut : scene.cuts)
    if (glm::all(glm::lessThan(DVec3(glm::min(cut.from, cut.to)), upper)) &&
        glm::all(glm::greaterThan(DVec3(glm::max(cut.from, cut.to)), lower)))
      near.push_back(cut);
  for (std::uint32_t edge = 0; edge < across.size() && !near.empty(); ++edge) {
    if (across[edge] == kNoEdge) continue;
    const Triangle3 t = triangle_corners(scene, surface.first_triangle + edge / 3);
    const DVec3 a = t[edge % 3], b = t[(edge + 1) % 3];
    const auto on = [&](const ChartCut& cut) {
      return std::max(distance_to(cut, a), distance_to(cut, b)) < kCutTolerance_m;
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
