// Flat surfaces that reflect as mirrors do: mirrors, panes, polished floors under a smooth coat. And frosted panes,
// which mirror light too, spread by facets, to their other side.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "bake/scene/shade.h"

namespace oriel {

// What of light passes into the mirror direction of a surface, per channel: F of lobes and coats narrower than
// kMirrorAlpha, [0,1]. 0 where all of them are wider.
Vec3 mirror_reflectance(const ShadePoint& point, float cos_theta);

// By how many metres a ray from there ends before a mirror: a pane would else stand in the way of its own light. As
// offset_origin reckons. cosine: to the mirror's normal.
double mirror_margin(const Scene& scene, std::uint32_t triangle, const Vec3& from, double cosine);

// Triangles in one plane, connected or not, that reflect on the side of the normal: the panes of a window wall are one.
struct PlanarMirror {
  DVec3 normal{0, 0, 1};  // unit
  double offset = 0;      // normal · p of its points, metres
  std::vector<std::uint32_t> triangles;
  std::vector<DVec3> hull;  // corners of the triangles' convex hull, counter-clockwise about the normal
  ShadePoint shade;         // in the middle of the largest triangle
  double area_m2 = 0;

  double height(const DVec3& p) const { return glm::dot(normal, p) - offset; }
  DVec3 mirrored(const DVec3& p) const { return p - 2 * height(p) * normal; }
  DVec3 turned(const DVec3& direction) const { return direction - 2 * glm::dot(normal, direction) * normal; }
};

// The planar mirrors of a scene. Surfaces with normal maps or bent normals are none, nor are those whose roughness is
// not below 0.01 without its texture. Of more than kMost planes the largest count. Immutable.
class PlanarMirrors {
 public:
  static constexpr std::size_t kMost = 512;

  PlanarMirrors() = default;
  explicit PlanarMirrors(const Scene& scene);
  // Flat frosted panes instead (is_frosted_pane), by both sides: opaque in their alpha, of one roughness, without solid
  // glass. Their mirror_reflectance() is 0.
  static PlanarMirrors frosted_panes(const Scene& scene);

  bool empty() const { return mirrors_.empty(); }
  std::size_t size() const { return mirrors_.size(); }
  const PlanarMirror& operator[](std::size_t m) const { return mirrors_[m]; }

  // Where a point of the mirror's plane lies on it; nothing beside it.
  struct On {
    std::uint32_t triangle;
    Vec2 barycentric;
  };
  std::optional<On> on(const Scene& scene, std::size_t mirror, const DVec3& p) const;
  // By triangle of the scene, whether it or its twin is in one of them; empty where there are none.
  std::vector<char> triangles_of(const Scene& scene) const;

 private:
  // Which triangles a part of a mirror's plane may hold.
  struct Grid {
    DVec3 u{1, 0, 0}, v{0, 1, 0};  // unit, in the plane
    DVec2 lower{0}, per_cell{0};   // cells a metre
    int columns = 1, rows = 1;
    std::vector<std::uint32_t> first;  // by cell, and one more: into `triangle`
    std::vector<std::uint32_t> triangle;
  };
  static Grid grid_of(const Scene& scene, const PlanarMirror& mirror);
  // of_material: which materials count; both_sides: of one-sided surfaces too.
  void collect(const Scene& scene, const std::vector<char>& of_material, bool both_sides);

  std::vector<PlanarMirror> mirrors_;
  std::vector<Grid> grids_;  // by mirror
};

}  // namespace oriel
