// Coplanar sets of triangles.
#pragma once

#include <span>
#include <vector>

#include "bake/scene/scene.h"

namespace oriel {

// Triangles near one plane: dot(normal, p) = offset in scene space, normal their area-weighted mean (front side).
struct PlanarPatch {
  std::vector<std::uint32_t> triangles;  // ascending
  DVec3 normal{0, 0, 1};
  double offset = 0;
  double area_m2 = 0;
  double flatness_m = 0;  // largest distance of a vertex from the plane
};

struct PatchOptions {
  double max_angle_rad = 0.0087266;
  double max_distance_m = 1e-4;     // of a vertex from the plane
  double relative_distance = 1e-3;  // the same, in square roots of the patch's area; the smaller one holds
  double min_distance_m = 1e-6;     // but never less than what float positions can tell apart
  double min_area_m2 = 0.25;        // smaller patches are not returned
};

// The patches of the given triangles (distinct, no order needed), largest first. Each triangle is in one patch at most.
// Work grows as n log n, curved meshes included.
std::vector<PlanarPatch> find_planar_patches(const Scene& scene, std::span<const std::uint32_t> triangles,
                                             const PatchOptions& options);

}  // namespace oriel
