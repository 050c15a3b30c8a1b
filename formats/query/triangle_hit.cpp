#include "formats/query/triangle_hit.h"

#include <algorithm>
#include <cmath>

namespace oriel {

std::optional<TriangleHit> meet_triangle(const Mesh& mesh, std::size_t first_index, const Vec3& from,
                                         const Vec3& direction) {
  const Vec3 a = mesh.positions[mesh.indices[first_index]];
  auto hit = meet_triangle(a, mesh.positions[mesh.indices[first_index + 1]] - a,
                           mesh.positions[mesh.indices[first_index + 2]] - a, from, direction);
  if (hit) hit->first_index = first_index;
  return hit;
}

bool TriangleHit::comes_before(const TriangleHit& other) const {
  constexpr float kSamePlace = 1e-5f;  // of the distance
  if (front != other.front && std::abs(distance - other.distance) <= kSamePlace * distance) return front;
  return distance < other.distance || (distance == other.distance && first_index < other.first_index);
}

std::optional<TriangleHit> first_triangle(const Mesh& mesh, const Vec3& from, const Vec3& direction) {
  std::optional<TriangleHit> first;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
    if (const auto hit = meet_triangle(mesh, i, from, direction); hit && (!first || hit->comes_before(*first)))
      first = hit;
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
