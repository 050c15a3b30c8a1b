// Shadow volumes of any triangles (Udeshi & Hansen 1999, section 2), closed or not, convex or not.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "bake/scene/scene.h"

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
// Surfaces that let light through (may_transmit) throw no shadow here.
class ShadowMesh {
 public:
  ShadowMesh() = default;
  explicit ShadowMesh(const Scene& scene);

  // Places that corners share, scene space.
  const std::vector<Vec3>& positions() const { return positions_; }
  std::size_t edges() const { return edges_.size(); }
  // light, eye: homogeneous, w = 1 a place, w = 0 the direction towards it. asked: the triangles, into
  // Scene::triangles, that alone may hold the eye in their volumes; none: all are asked, which is exact.
  ShadowVolumes volumes(const Vec4& light, const Vec4& eye,
                        const std::optional<std::vector<std::uint32_t>>& asked = {}) const;

 private:
  struct Edge {
    std::uint32_t a = 0, b = 0;  // into positions_, a < b
    std::uint32_t first = 0;     // into sides_; up to the next edge's
    bool halved = false;         // of a body whose edges all have an even number of triangles: all counts are even
  };
  struct Plane {
    DVec3 normal{0};
    double offset = 0;
  };
  bool faces(std::size_t triangle, const Vec4& from) const;
  std::uint32_t volumes_around(const Vec4& eye, const Vec4& light, const std::vector<char>& lit,
                               std::span<const std::uint32_t> asked) const;
  void weld(const Scene& scene, const std::vector<std::uint32_t>& opaque);
  void find_edges();

  std::vector<Vec3> positions_;
  std::vector<UVec3> triangles_;         // into positions_
  std::vector<std::uint32_t> all_;       // 0, 1, … of them
  std::vector<std::uint32_t> of_scene_;  // by Scene::triangles: into triangles_, ~0u where it throws no shadow
  std::vector<Plane> planes_;            // by triangle
  std::vector<Edge> edges_;
  std::vector<std::uint32_t> sides_;  // triangle * 2 + 1 where it goes from a to b, else triangle * 2
  std::vector<std::uint32_t> body_;   // by triangle: of those that edges join, the least
  std::vector<char> even_;            // by triangle that names a body
};

}  // namespace oriel
