// What people see of a scene: how much of their view each triangle fills, and from how far.
#pragma once

#include "bake/visibility/eye_region.h"

namespace oriel {

// All headings count alike: frames of 60° in every direction come to rays spread evenly over the sphere.
struct ViewImportanceOptions {
  std::uint32_t eyes = 1024;       // drawn from the region
  std::uint32_t directions = 512;  // of each
  float nearest_m = 0.5f;          // nearer, things count as that near: nobody stands closer to a wall for long
};

struct TriangleView {
  float pixels = 0;          // rays that met the triangle, by way of one mirror and of panes too
  float inverse_square = 0;  // Σ 1/d² of them, d the way from the eye in metres
};

struct ViewImportance {
  std::vector<TriangleView> triangles;
  double rays = 0;  // that left eyes
};

// Where the region is the scene's box because nobody can stand in it, half of the eyes stand around the scene, as far
// away as it is large: such a scene is often one object. Error kStopped.
Result<ViewImportance> find_view_importance(const Accel& accel, const EyeRegion& region,
                                            const ViewImportanceOptions& options, Context& context);

}  // namespace oriel
