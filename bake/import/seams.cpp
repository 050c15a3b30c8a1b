#include "bake/import/seams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <tuple>
#include <unordered_map>

#include "bake/scene/edges.h"
#include "formats/core/disjoint_sets.h"

namespace oriel {
namespace {

constexpr float kOfSize = 1e-6f, kOfCoordinates = 0x1p-22f;
constexpr double kLeastArea = 0.5;  // that a triangle keeps

class Seams {
 public:
  Seams(Scene& scene, const Surface& surface)
      : positions_(std::span(scene.positions).subspan(surface.first_vertex, surface.vertex_count)),
        corners_(welded_corners(scene, surface)) {}

  void join() {
    const std::vector<std::uint32_t> open = open_places();
    if (open.empty()) return;
    std::vector<std::uint32_t> first = near_each_other(open);
    while (leave_triangles_alone(first)) {
    }
    const std::vector<std::uint32_t> welded = weld(positions_);
    for (std::uint32_t v = 0; v < positions_.size(); ++v)
      if (first[welded[v]] != welded[v]) positions_[v] = positions_[first[welded[v]]];
  }

 private:
  // Welded vertices at the ends of edges that one triangle has alone; ascending by x, y, z.
  std::vector<std::uint32_t> open_places() const {
    std::vector<std::uint32_t> open;
    for_each_edge(edge_uses(corners_), [&](std::span<const EdgeUse> uses) {
      if (uses.size() == 1) open.push_back(uses[0].low), open.push_back(uses[0].high);
    });
    std::ranges::sort(open, {},
                      [&](std::uint32_t v) { return std::tuple(positions_[v].x, positions_[v].y, positions_[v].z); });
    open.erase(std::ranges::unique(open).begin(), open.end());
    return open;
  }

  // By welded vertex: the first of the open places that it is one with.
  std::vector<std::uint32_t> near_each_other(const std::vector<std::uint32_t>& open) const {
    std::vector<std::uint32_t> first(positions_.size());
    std::iota(first.begin(), first.end(), 0u);
    Vec3 lower = positions_[open.front()], upper = lower, farthest(0);
    for (const Vec3& p : positions_)
      lower = glm::min(lower, p), upper = glm::max(upper, p), farthest = glm::max(farthest, glm::abs(p));
    const float reach = std::max(kOfSize * glm::length(upper - lower), kOfCoordinates * max_component(farthest));
    if (!(reach > 0)) return first;
    DisjointSets sets(open.size());
    // Cells as wide as the reach: what is near lies in one of the 27 around.
    using Cell = std::array<std::int64_t, 3>;
    const auto cell_of = [&](const Vec3& p) {
      const DVec3 at = glm::floor(DVec3(p - lower) / double{reach});
      return Cell{static_cast<std::int64_t>(at.x), static_cast<std::int64_t>(at.y), static_cast<std::int64_t>(at.z)};
    };
    const auto hash = [](const Cell& c) {
      return static_cast<std::size_t>(c[0] * 73856093 ^ c[1] * 19349663 ^ c[2] * 83492791);
    };
    std::unordered_map<Cell, std::vector<std::uint32_t>, decltype(hash)> cells(open.size(), hash);
    for (std::uint32_t i = 0; i < open.size(); ++i) {
      const Vec3& at = positions_[open[i]];
      const Cell cell = cell_of(at);
      for (int n = 0; n < 27; ++n)
        if (const auto near = cells.find({cell[0] + n % 3 - 1, cell[1] + n / 3 % 3 - 1, cell[2] + n / 9 - 1});
            near != cells.end())
          for (const std::uint32_t j : near->second)
            if (glm::length(at - positions_[open[j]]) <= reach) sets.join(i, j);
      cells[cell].push_back(i);
    }
    for (std::uint32_t i = 0; i < open.size(); ++i) first[open[i]] = open[sets.root(i)];
    return first;
  }

  // Takes back what would leave a triangle without area; whether there was any.
  bool leave_triangles_alone(std::vector<std::uint32_t>& first) const {
    std::vector<char> kept(first.size(), 0);  // by set
    bool any = false;
    for (std::size_t t = 0; t + 2 < corners_.size(); t += 3) {
      const std::uint32_t* c = &corners_[t];
      if (first[c[0]] == c[0] && first[c[1]] == c[1] && first[c[2]] == c[2]) continue;
      const auto normal = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
        const DVec3 a(positions_[x]);
        return glm::cross(DVec3(positions_[y]) - a, DVec3(positions_[z]) - a);
      };
      const DVec3 before = normal(c[0], c[1], c[2]);
      if (glm::dot(normal(first[c[0]], first[c[1]], first[c[2]]), before) > kLeastArea * glm::dot(before, before))
        continue;
      for (int k = 0; k < 3; ++k) kept[first[c[k]]] = 1;
      any = true;
    }
    if (any)
      for (std::uint32_t i = 0; i < first.size(); ++i)
        if (kept[first[i]] != 0) first[i] = i;
    return any;
  }

  std::span<Vec3> positions_;
  std::vector<std::uint32_t> corners_;  // welded, three a triangle
};

}  // namespace

void join_seams(Scene& scene) {
  for (const Surface& surface : scene.surfaces) Seams(scene, surface).join();
}

}  // namespace oriel
