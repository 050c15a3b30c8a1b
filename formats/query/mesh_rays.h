// Rays against a pack's mesh by a hierarchy of boxes: for what is asked hundreds of times.
#pragma once

#include <span>

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
  // Whether anything is between two points; what is within a share of 1e-4 of `to` does not count. last: what was in
  // the way of a ray nearby, to be asked first; becomes what is in this one's. Any number will do.
  bool blocks(const Vec3& from, const Vec3& to, std::uint32_t& last) const;
  // As part_of_triangle(), at once; none: a damaged mesh.
  std::optional<std::uint32_t> part(std::size_t first_index) const;

 private:
  struct Node {
    Vec3 lower{0};
    std::uint32_t first = 0;  // of corners_; of an inner node its children are at first and first + 1
    Vec3 upper{0};
    std::uint32_t count = 0;  // 0: an inner node
  };
  struct Corners {  // of a triangle: one of them, and the ways to the others
    Vec3 a{0}, ab{0}, ac{0};
    std::uint32_t triangle = 0;  // first index over 3
  };
  struct Boxed;
  void build(std::uint32_t node, std::span<Boxed> triangles, int depth);
  // visit(corners): false ends it. farthest: of boxes that are asked, which it may change.
  template <class Visit>
  void along(const Vec3& from, const Vec3& direction, const float& farthest, const Visit& visit) const;

  const Mesh* mesh_;
  std::vector<Corners> corners_;
  std::vector<std::uint32_t> part_of_;  // by triangle; ~0u: none
  std::vector<Node> nodes_;
};

}  // namespace oriel
