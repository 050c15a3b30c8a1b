// Rays against a pack's mesh, one triangle after the other: for what is asked a few times.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "formats/assets/mesh.h"

namespace oriel {

// A triangle that a ray meets: its place among the mesh's indices, how far along `direction` (any length), and the
// shares of its second and third corner there. front: it is met from there.
struct TriangleHit {
  std::size_t first_index = 0;
  float distance = 0, u = 0, v = 0;
  bool front = true;

  // Whether a ray that meets both meets this one first. Of triangles in one place, as are the two sides of a sheet, it
  // is the one that faces the ray, then the first of the mesh.
  bool comes_before(const TriangleHit& other) const;
};

// A triangle by one corner and the ways to the others (Moeller and Trumbore 1997); of the mesh, its number is not told.
inline std::optional<TriangleHit> meet_triangle(const Vec3& a, const Vec3& ab, const Vec3& ac, const Vec3& from,
                                                const Vec3& direction) {
  const Vec3 p = glm::cross(direction, ac), to = from - a, q = glm::cross(to, ab);
  const float scale = 1 / glm::dot(ab, p), u = glm::dot(to, p) * scale, v = glm::dot(direction, q) * scale;
  const float t = glm::dot(ac, q) * scale;
  if (!(u >= 0 && v >= 0 && u + v <= 1 && t > 0)) return std::nullopt;
  return TriangleHit{0, t, u, v, scale > 0};
}

// That triangle, from either side.
std::optional<TriangleHit> meet_triangle(const Mesh& mesh, std::size_t first_index, const Vec3& from,
                                         const Vec3& direction);
// The first one, from either side.
std::optional<TriangleHit> first_triangle(const Mesh& mesh, const Vec3& from, const Vec3& direction);
// All of them up to `farthest`, the nearest first.
std::vector<TriangleHit> triangles_along(const Mesh& mesh, const Vec3& from, const Vec3& direction,
                                         float farthest = std::numeric_limits<float>::infinity());

// The part that a triangle belongs to, into Mesh::parts; none: a damaged mesh.
std::optional<std::uint32_t> part_of_triangle(const Mesh& mesh, std::size_t first_index);
// Unit, of its front; 0 where it has no area.
Vec3 triangle_normal(const Mesh& mesh, std::size_t first_index);

}  // namespace oriel
