// Rays against a pack's mesh by a hierarchy of boxes: for what is asked hundreds of times.
#pragma once

#include "formats/query/triangle_hit.h"

namespace oriel {

class MeshRays {
 public:
  // Refers to the mesh, which outlives it. Some tenths of a second for a million triangles.
  explicit MeshRays(const Mesh& mesh);

  const Mesh& mesh() const { return *mesh_; }
  // As first_triangle(), up to `farthest`.
  std::optional<TriangleHit> first(const Vec3& from, const Vec3& direction,
                                   float farthest = std::numeric_limits<float>::infinity()) const;
  // Whether anything is between two points; what is within a share of 1e-4 of `to` does not count.
  bool blocks(const Vec3& from, const Vec3& to) const;
  // As part_of_triangle(), at once; none: a damaged mesh.
  std::optional<std::uint32_t> part(std::size_t first_index) const;

 private:
  // visit(index of a triangle): false ends it. farthest: of boxes that are asked, which it may change.
  template <class Visit>
  void along(const Vec3& from, const Vec3& direction, const float& farthest, const Visit& visit) const;
  struct Node {
    Vec3 lower{0}, upper{0};
    std::uint32_t first = 0, count = 0;  // of triangles_; count 0: the children are at first and first + 1
  };
  void build(std::uint32_t node, std::uint32_t first, std::uint32_t count, const std::vector<Vec3>& centres);
  const Mesh* mesh_;
  std::vector<std::uint32_t> triangles_;  // first indices over 3
  std::vector<std::uint32_t> part_of_;    // by triangle; ~0u: none
  std::vector<Node> nodes_;
};

}  // namespace oriel
