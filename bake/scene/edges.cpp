#include "bake/scene/edges.h"

#include <algorithm>
#include <tuple>

#include "formats/core/numbering.h"
#include "formats/core/position_hash.h"

namespace oriel {

std::vector<std::uint32_t> weld(std::span<const Vec3> positions) {
  Numbering<Vec3, PositionHash> places(positions.size());
  std::vector<std::uint32_t> first, welded;
  welded.reserve(positions.size());
  for (std::uint32_t v = 0; v < positions.size(); ++v) {
    const std::uint32_t place = places(positions[v]);
    if (place == first.size()) first.push_back(v);
    welded.push_back(first[place]);
  }
  return welded;
}

std::vector<std::uint32_t> welded_corners(const Scene& scene, const Surface& surface) {
  const auto welded = weld(std::span(scene.positions).subspan(surface.first_vertex, surface.vertex_count));
  std::vector<std::uint32_t> corners;
  corners.reserve(std::size_t{3} * surface.triangle_count);
  for (const UVec3& t : std::span(scene.triangles).subspan(surface.first_triangle, surface.triangle_count))
    for (int k = 0; k < 3; ++k) corners.push_back(welded[t[k] - surface.first_vertex]);
  return corners;
}

std::vector<EdgeUse> edge_uses(std::span<const std::uint32_t> corners) {
  std::vector<std::uint32_t> end(corners.empty() ? 0 : *std::ranges::max_element(corners) + 1);  // by low vertex
  const auto for_each_use = [&](const auto& visit) {
    for (std::uint32_t t = 0; t + 2 < corners.size(); t += 3) {
      const std::uint32_t w[3] = {corners[t], corners[t + 1], corners[t + 2]};
      if (w[0] == w[1] || w[1] == w[2] || w[2] == w[0]) continue;
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t a = w[k], b = w[(k + 1) % 3];
        visit(EdgeUse{std::min(a, b), std::max(a, b), t + k, a < b});
      }
    }
  };
  for_each_use([&](const EdgeUse& use) { ++end[use.low]; });
  std::uint32_t count = 0;
  for (std::uint32_t& e : end) e = (count += e) - e;  // where its uses begin; they end there when all are written
  std::vector<EdgeUse> uses(count);
  for_each_use([&](const EdgeUse& use) { uses[end[use.low]++] = use; });
  for (std::uint32_t first = 0; const std::uint32_t last : end) {
    std::sort(uses.begin() + first, uses.begin() + last, [](const EdgeUse& a, const EdgeUse& b) {
      return std::tie(a.high, a.corner) < std::tie(b.high, b.corner);
    });
    first = last;
  }
  return uses;
}

}  // namespace oriel
