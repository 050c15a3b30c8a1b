#include "bake/import/seams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include "formats/core/disjoint_sets.h"

namespace oriel {
namespace {

constexpr float kOfSize = 1e-6f, kOfCoordinates = 0x1p-22f;
constexpr double kLeastArea = 0.5;  // that a triangle keeps

class Seams {
 public:
  Seams(Scene& scene, const Surface& surface) : scene_(scene), surface_(surface) {}

  void join() {
    number_places();
    const std::vector<std::uint32_t> open = open_places();
    if (open.empty()) return;
    DisjointSets sets = near_each_other(open);
    std::vector<std::uint32_t> first(places_.size());  // of the places that are one
    for (std::uint32_t i = 0; i < places_.size(); ++i) first[i] = static_cast<std::uint32_t>(sets.root(i));
    while (leave_triangles_alone(first)) {
    }
    for (std::uint32_t v = 0; v < surface_.vertex_count; ++v)
      if (const std::uint32_t at = place_of_[v]; first[at] != at) position(v) = places_[first[at]];
  }

 private:
  Vec3& position(std::uint32_t v) { return scene_.positions[surface_.first_vertex + v]; }
  std::array<std::uint32_t, 3> corners(std::uint32_t t) const {
    const UVec3 v = scene_.triangles[surface_.first_triangle + t] - surface_.first_vertex;
    return {place_of_[v.x], place_of_[v.y], place_of_[v.z]};
  }

  // Vertices at the same position are one place.
  void number_places() {
    std::vector<std::uint32_t> order(surface_.vertex_count);
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](std::uint32_t v) {
      const Vec3& p = position(v);
      return std::tuple(p.x, p.y, p.z);
    };
    std::ranges::sort(order,
                      [&](std::uint32_t a, std::uint32_t b) { return std::tuple(key(a), a) < std::tuple(key(b), b); });
    place_of_.resize(order.size());
    for (const std::uint32_t v : order) {
      if (places_.empty() || places_.back() != position(v)) places_.push_back(position(v));
      place_of_[v] = static_cast<std::uint32_t>(places_.size() - 1);
    }
  }

  // The ends of edges that one triangle has alone; ascending.
  std::vector<std::uint32_t> open_places() const {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    edges.reserve(std::size_t{3} * surface_.triangle_count);
    for (std::uint32_t t = 0; t < surface_.triangle_count; ++t) {
      const auto c = corners(t);
      for (std::size_t k = 0; k < 3; ++k) edges.emplace_back(std::minmax(c[k], c[(k + 1) % 3]));
    }
    std::ranges::sort(edges);
    std::vector<std::uint32_t> open;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const bool alone = (i == 0 || edges[i - 1] != edges[i]) && (i + 1 == edges.size() || edges[i + 1] != edges[i]);
      if (alone) open.push_back(edges[i].first), open.push_back(edges[i].second);
    }
    std::ranges::sort(open);
    open.erase(std::ranges::unique(open).begin(), open.end());
    return open;
  }

  DisjointSets near_each_other(const std::vector<std::uint32_t>& open) const {
    Vec3 lower = places_[open.front()], upper = lower, farthest(0);
    for (const Vec3& p : places_)
      lower = glm::min(lower, p), upper = glm::max(upper, p), farthest = glm::max(farthest, glm::abs(p));
    const float reach = std::max(kOfSize * glm::length(upper - lower), kOfCoordinates * max_component(farthest));
    DisjointSets sets(places_.size());
    if (!(reach > 0)) return sets;
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
    for (const std::uint32_t i : open) {
      const Cell cell = cell_of(places_[i]);
      for (int n = 0; n < 27; ++n)
        if (const auto near = cells.find({cell[0] + n % 3 - 1, cell[1] + n / 3 % 3 - 1, cell[2] + n / 9 - 1});
            near != cells.end())
          for (const std::uint32_t j : near->second)
            if (glm::length(places_[i] - places_[j]) <= reach) sets.join(i, j);
      cells[cell].push_back(i);
    }
    return sets;
  }

  // Takes back what would leave a triangle without area; whether there was any.
  bool leave_triangles_alone(std::vector<std::uint32_t>& first) const {
    std::vector<char> kept(places_.size(), 0);  // by set
    bool any = false;
    for (std::uint32_t t = 0; t < surface_.triangle_count; ++t) {
      const auto c = corners(t);
      if (first[c[0]] == c[0] && first[c[1]] == c[1] && first[c[2]] == c[2]) continue;
      const auto normal = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
        const DVec3 a(places_[x]);
        return glm::cross(DVec3(places_[y]) - a, DVec3(places_[z]) - a);
      };
      const DVec3 before = normal(c[0], c[1], c[2]);
      if (glm::dot(normal(first[c[0]], first[c[1]], first[c[2]]), before) > kLeastArea * glm::dot(before, before))
        continue;
      for (const std::uint32_t corner : c) kept[first[corner]] = 1;
      any = true;
    }
    if (any)
      for (std::uint32_t i = 0; i < first.size(); ++i)
        if (kept[first[i]] != 0) first[i] = i;
    return any;
  }

  Scene& scene_;
  const Surface& surface_;
  std::vector<Vec3> places_;             // ascending by x, y, z
  std::vector<std::uint32_t> place_of_;  // by vertex
};

}  // namespace

void join_seams(Scene& scene) {
  for (const Surface& surface : scene.surfaces) Seams(scene, surface).join();
  keep_face_normals(scene);
}

}  // namespace oriel
