#include "bake/atlas/congruent.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace oriel {
namespace {

constexpr float kRounding = 1e-4f;       // of an edge, and of a cosine: of corners some metres from the origin
constexpr std::size_t kMostShapes = 16;  // of one mesh, as its scales: more are compared with no others

struct FrontFace {
  UVec3 corners;  // numbered from the surface's first vertex
  Vec3 edges;     // lengths
  Vec3 normal;
};

FrontFace front_face(const Scene& scene, const Surface& surface, std::uint32_t i) {
  const UVec3& t = scene.triangles[surface.first_triangle + i];
  const Vec3 &a = scene.positions[t.x], &b = scene.positions[t.y], &c = scene.positions[t.z];
  return {t - UVec3(surface.first_vertex),
          {glm::length(b - a), glm::length(c - b), glm::length(a - c)},
          geometric_normal(scene, surface.first_triangle + i)};
}

// The same edges in the same order, folded by the same angles from triangle to triangle.
bool congruent(const Scene& scene, const Surface& a, const Surface& b) {
  FrontFace last_a, last_b;
  for (std::uint32_t i = 0; i < a.triangle_count; ++i) {
    const FrontFace of_a = front_face(scene, a, i), of_b = front_face(scene, b, i);
    if (of_a.corners != of_b.corners) return false;
    const float off = kRounding * std::max({of_a.edges.x, of_a.edges.y, of_a.edges.z});
    if (glm::any(glm::greaterThan(glm::abs(of_a.edges - of_b.edges), Vec3(off)))) return false;
    const float turn = glm::dot(of_a.normal, last_a.normal) - glm::dot(of_b.normal, last_b.normal);
    if (i > 0 && std::abs(turn) > kRounding) return false;
    last_a = of_a, last_b = of_b;
  }
  return true;
}

bool in_one_ring(const TexelDemand* demand, const Surface& surface) {
  for (std::uint32_t i = 1; demand != nullptr && i < surface.triangle_count; ++i)
    if (demand->ring(surface.first_triangle + i) != demand->ring(surface.first_triangle)) return false;
  return true;
}

}  // namespace

std::vector<std::uint32_t> first_congruent(const Scene& scene, std::span<const std::uint32_t> surfaces,
                                           const TexelDemand* demand) {
  std::vector<std::uint32_t> first;
  using Shape = std::tuple<std::string, std::uint32_t, std::uint32_t, std::uint32_t, float>;
  std::map<Shape, std::vector<std::uint32_t>> shapes;
  for (std::uint32_t i = 0; i < surfaces.size(); ++i) {
    const Surface& s = scene.surfaces[surfaces[i]];
    first.push_back(i);
    if (!in_one_ring(demand, s)) continue;
    std::vector<std::uint32_t>& known = shapes[{s.mesh_name, s.material, s.triangle_count, s.vertex_count, s.texel_m}];
    const auto found =
        std::ranges::find_if(known, [&](std::uint32_t k) { return congruent(scene, scene.surfaces[surfaces[k]], s); });
    if (found != known.end())
      first.back() = *found;
    else if (known.size() < kMostShapes)
      known.push_back(i);
  }
  return first;
}

}  // namespace oriel
