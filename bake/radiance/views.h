// Where radiance maps are taken from: elements of a reflector and viewpoints behind each (Bastos et al. 1999, section
// 8.1.3, "Sampling of the plenoptic function").
#pragma once

#include <string>
#include <vector>

#include "bake/radiance/elements.h"

namespace oriel {

// The last ring of directions lies `short_of` steps between rings before the arc from the pole ends.
struct RingArc {
  double arc_rad = 75 * kPiD / 180;  // views closer to the plane see it edge-on
  double short_of = 0;
};

// Unit vectors with z < 0: the pole (0, 0, -1), then rings at evenly spaced arcs from it, each with points at about the
// same spacing. Exactly `count` of them, at least 1.
std::vector<Vec3> hemisphere_directions(std::uint32_t count, const RingArc& rings = {});

struct ViewPlan {
  std::vector<RadianceMap> maps;     // everything but the pixels; by reflector, element (row by row), viewpoint
  std::vector<std::string> omitted;  // what was reduced or left out and why, one line each
};

// Whether the point is in the scene's bounds, or no further out than the margin along any axis.
bool is_inside(const Scene& scene, const Vec3& p, float margin);

}  // namespace oriel
