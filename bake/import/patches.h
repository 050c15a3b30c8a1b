// Patches of surfaces that lie in one plane, and which of them overlap (coplanar.h).
#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "bake/scene/scene.h"
#include "formats/core/disjoint_sets.h"
#include "formats/core/position_hash.h"

namespace oriel {

// A triangle and the cell of planes that its own is in.
struct Planar {
  std::uint64_t cell = 0;
  std::uint32_t triangle = 0;
  bool operator<(const Planar& o) const { return std::tie(cell, triangle) < std::tie(o.cell, o.triangle); }
};

// A patch that lies on others, or lets light through and may lie on what faces it.
struct Layer {
  std::vector<std::uint32_t> triangles;
  std::uint32_t patch = 0;
  std::uint32_t below = 0;  // a surface that it lies on
  int level = 0;            // layers below it; 0: it lets light through
};

// Whether a surface of the material lets light through, all of it or by places.
bool lets_through(const SceneMaterial& material);

// What lies in one plane. one_place: of what is no further apart than that, metres, rays cannot tell which is in front.
// lift: by which each layer is moved; what lies less in front of one gives way.
class PlanePatches {
 public:
  PlanePatches(const Scene& scene, double one_place, double lift) : scene_(scene), one_place_(one_place), lift_(lift) {}

  // The patches of these triangles that lie on others or let light through. They are of one cell, in the order of the
  // scene.
  std::vector<Layer> layers(std::span<const Planar> triangles);
  // Of the last triangles: the first surface of others that lets no light through and of which a triangle overlaps one
  // of the layer, seen along the plane's normal; ~0u: none.
  std::uint32_t met(const Layer& layer, std::span<const Planar> others) const;
  // Likewise: whether a vertex is one of another patch.
  bool has_elsewhere(std::uint32_t vertex, std::uint32_t patch) const;

 private:
  struct Patch {
    std::vector<std::uint32_t> members;  // into triangles_
    double area = 0;
    bool lets_through = false;
    std::set<std::uint32_t> overlaps;        // patches in its place
    std::map<std::uint32_t, double> behind;  // patches less than a lift behind it, and how far, m
  };
  struct Flat {
    std::array<DVec2, 3> corners;  // counter-clockwise, along the two axes that the plane faces least
    DVec2 lower, upper;
    double area = 0;
    std::uint32_t patch = 0;
  };

  const Surface& surface(std::uint32_t member) const {
    return scene_.surfaces[scene_.triangle_surface[triangles_[member].triangle]];
  }
  bool all_apart(std::span<const Planar> triangles) const;
  DisjointSets connected() const;
  void find_patches();
  void project();
  Flat flattened(std::uint32_t triangle) const;
  static bool boxes_meet(const Flat& a, const Flat& b);
  static bool overlap(const Flat& a, const Flat& b);
  std::optional<double> rise(std::uint32_t i, std::uint32_t k) const;
  void find_overlaps();
  void compare(std::uint32_t i, std::uint32_t k);
  std::vector<int> levels(std::span<const std::uint32_t> order, std::vector<std::uint32_t>& below) const;
  std::vector<Layer> stack();

  const Scene& scene_;
  double one_place_, lift_;
  int drop_ = 0;                   // the axis that the plane faces most
  std::vector<Planar> triangles_;  // in the order of the scene
  std::vector<std::uint32_t> patch_of_;
  std::unordered_map<std::uint32_t, std::uint32_t> patch_of_vertex_;
  std::vector<Patch> patches_;
  std::vector<Flat> flat_;
};

}  // namespace oriel
