// Shadow volumes of any triangles (Udeshi & Hansen 1999, section 2), closed or not, convex or not.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "formats/core/vec.h"

namespace oriel {

// What the shadow volumes of a light are drawn from.
struct ShadowVolumes {
  // Triangles of side quads, fronts outwards: vertex 2v is ShadowMesh::positions()[v], 2v + 1 the same thrown to
  // infinity away from the light. A quad is there as often as a ray through it enters that many volumes.
  std::vector<std::uint32_t> indices;
  std::uint32_t around_eye = 0;  // volumes that hold the eye: what counting along a ray begins with
};

// Every opaque triangle is an occluder, turned to face the light. Volumes of neighbours that face it alike join: their
// common quad would count once in and once out, and is left out (Bergeron 1986, "A General Version of Crow's Shadow
// Volumes"). What is left is the silhouettes, whatever the mesh. Between the eye and what it sees no triangle is
// crossed, so no caps are needed: volumes around the eye, counted exactly on the processor (U2), plus those that side
// quads before the surface enter, less those that they leave, are the triangles between the surface and the light.
//
// Where the eye may see through a triangle that throws a shadow, the back of a one-sided surface or what a mirror's
// plane cuts away, the triangle itself is crossed: whole_volumes() has it too, and no body is counted by halves there.
class ShadowMesh {
 public:
  ShadowMesh() = default;
  // throws: by triangle, 0 where it throws no shadow; empty: all do. Corners are into `positions`. Triangles without
  // area throw none.
  ShadowMesh(std::span<const Vec3> positions, std::span<const UVec3> triangles, std::span<const char> throws = {});

  // Places that corners share, scene space.
  const std::vector<Vec3>& positions() const { return positions_; }
  std::size_t edges() const { return edges_.size(); }
  std::size_t triangles() const { return triangles_.size(); }
  std::size_t bytes() const;  // in memory
  // light, eye: homogeneous, w = 1 a place, w = 0 the direction towards it. asked: the given
  // triangles that alone may hold the eye in their volumes; none: all are asked, which is exact.
  ShadowVolumes volumes(const Vec4& light, const Vec4& eye,
                        const std::optional<std::vector<std::uint32_t>>& asked = {}) const;

  // Side quads, each as often as a ray that crosses it enters volumes of triangles, then the triangles themselves,
  // fronts to the light: vertices as ShadowVolumes::indices. A triangle in whose plane the light lies (within a
  // hundred-thousandth of the mesh's size) throws no shadow.
  struct WholeVolumes {
    std::vector<std::uint32_t> indices;
    std::size_t sides = 0;  // of the indices
  };
  WholeVolumes whole_volumes(const Vec4& light) const;
  // The volumes of triangles that hold a place: triangles between it and the light.
  std::uint32_t triangles_between(const Vec4& place, const Vec4& light) const;

 private:
  enum Side : char { kAway, kFacing, kEdgeOn };
  struct Edge {
    std::uint32_t a = 0, b = 0;  // into positions_, a < b
    std::uint32_t first = 0;     // into sides_; up to the next edge's
    bool halved = false;         // of a body whose edges all have an even number of triangles: all counts are even
  };
  struct Plane {
    DVec3 normal{0};
    double offset = 0;
  };
  void add_sides(std::span<const signed char> turns, bool halve, std::vector<std::uint32_t>& indices) const;
  bool faces(std::size_t triangle, const Vec4& from) const;
  Side side_of(std::size_t triangle, const Vec4& light) const;
  bool crossed(std::size_t triangle, const Vec4& place, const Vec4& light, bool lit) const;
  std::uint32_t volumes_around(const Vec4& eye, const Vec4& light, const std::vector<char>& lit,
                               std::span<const std::uint32_t> asked) const;
  void weld(std::span<const Vec3> positions, std::span<const UVec3> triangles);
  void find_edges();

  std::vector<Vec3> positions_;
  std::vector<UVec3> triangles_;      // into positions_
  std::vector<std::uint32_t> all_;    // 0, 1, … of them
  std::vector<std::uint32_t> given_;  // by triangle given: into triangles_, ~0u where it throws no shadow
  std::vector<Plane> planes_;         // by triangle
  std::vector<Edge> edges_;
  std::vector<std::uint32_t> sides_;  // triangle * 2 + 1 where it goes from a to b, else triangle * 2
  std::vector<std::uint32_t> body_;   // by triangle: of those that edges join, the least
  std::vector<char> even_;            // by triangle that names a body
  double flat_ = 0;                   // metres from a triangle's plane within which it is edge-on
};

}  // namespace oriel
