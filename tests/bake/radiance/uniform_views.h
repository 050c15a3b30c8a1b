// Radiance maps from hemispheres behind all elements of all reflectors: what tests capture that plan nothing.
#pragma once

#include "bake/radiance/reproject.h"
#include "bake/radiance/views.h"

namespace oriel {

struct ViewOptions {
  float element_m = 3;
  std::uint32_t views_per_element = 16, map_resolution = 256;
};

// Without pixels; sets each reflector's elements_x, elements_y, first_map and map_count. Eyes outside the scene are
// left out.
inline ViewPlan plan_views(const Scene& scene, std::vector<FoundReflector>& reflectors, const ViewOptions& options) {
  ViewPlan plan;
  for (std::uint32_t r = 0; r < reflectors.size(); ++r) {
    Reflector& out = reflectors[r].reflector;
    const ElementGrid grid = element_grid(out.upper - out.lower, options.element_m, 16);
    out.elements_x = grid.x, out.elements_y = grid.y;
    out.first_map = static_cast<std::uint32_t>(plan.maps.size());
    for (const Element& element : covered_elements(scene, reflectors[r], grid))
      for (const Vec3& direction : hemisphere_directions(options.views_per_element, {0.5 * kPiD, 0.5})) {
        const float radius = 0.5f * glm::length(element.upper - element.lower);
        const Vec3 eye = Vec3(0.5f * (element.lower + element.upper), 0) + radius * direction;
        if (is_inside(scene, pack_from_reflector(out, mirrored(eye)), radius))
          plan.maps.push_back(blank_map(r, eye, element, options.map_resolution));
      }
    out.map_count = static_cast<std::uint32_t>(plan.maps.size()) - out.first_map;
  }
  return plan;
}

}  // namespace oriel
