#include "formats/query/triangle_hit.h"

#include <algorithm>

namespace oriel {
// Moeller and Trumbore 1997.
std::optional<TriangleHit> meet_triangle(const Mesh& mesh, std::size_t first_index, const Vec3& from,
                                         const Vec3& direction) {
  const Vec3 a = mesh.positions[mesh.indices[first_index]];
  const Vec3 ab = mesh.positions[mesh.indices[first_index + 1]] - a;
  const Vec3 ac = mesh.positions[mesh.indices[first_index + 2]] - a;
  const Vec3 p = glm::cross(direction, ac), to = from - a, q = glm::cross(to, ab);
  const float scale = 1 / glm::dot(ab, p), u = glm::dot(to, p) * scale, v = glm::dot(direction, q) * scale;
  const float t = glm::dot(ac, q) * scale;
  if (!(u >= 0 && v >= 0 && u + v <= 1 && t > 0)) return std::nullopt;
  return TriangleHit{first_index, t, u, v};
}

std::optional<TriangleHit> first_triangle(const Mesh& mesh, const Vec3& from, const Vec3& direction) {
  std::optional<TriangleHit> first;
  float nearest = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
    if (const auto hit = meet_triangle(mesh, i, from, direction); hit && hit->distance < nearest)
      first = hit, nearest = hit->distance;
  return first;
}

std::vector<TriangleHit> triangles_along(const Mesh& mesh, const Vec3& from, const Vec3& direction, float farthest) {
  std::vector<TriangleHit> hits;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
    if (const auto hit = meet_triangle(mesh, i, from, direction); hit && hit->distance <= farthest)
      hits.push_back(*hit);
  std::stable_sort(hits.begin(), hits.end(),
                   [](const TriangleHit& a, const TriangleHit& b) { return a.distance < b.distance; });
  return hits;
}

std::optional<std::uint32_t> part_of_triangle(const Mesh& mesh, std::size_t first_index) {
  for (std::uint32_t p = 0; p < mesh.parts.size(); ++p) {
    const MeshPart& part = mesh.parts[p];
    if (first_index >= part.first_index && first_index < part.first_index + part.index_count) return p;
  }
  return std::nullopt;
}

Vec3 triangle_normal(const Mesh& mesh, std::size_t first_index) {
  const Vec3 a = mesh.positions[mesh.indices[first_index]];
  const Vec3 n =
      glm::cross(mesh.positions[mesh.indices[first_index + 1]] - a, mesh.positions[mesh.indices[first_index + 2]] - a);
  return normalize_or(n, Vec3(0));
}

}  // namespace oriel
