// Points and spots as lamps that glossy reflectors show.
#pragma once

#include <optional>

#include "bake/trace/polygon_light.h"

namespace oriel {

// The plane of a reflector, and points just over it.
struct LitPlane {
  Vec3 normal{0, 0, 1};
  std::span<const Vec3> nodes;
  bool turns = false;  // a light's square counts as if it turned to whoever sees it
};

// A small square in the place of a point or spot light that faces a plane. Towards the node that it sends most to,
// each weighted as it shows the square, it is as bright as the light; towards others by fade_of_square; at grazing
// incidence it may be darker. Nothing for
// other lights, for those at or behind the plane, and for those that do not shine on it.
std::optional<PolygonLight> punctual_square(const Scene& scene, const Light& light, const LitPlane& plane);

// What the light has towards a point over what the square has, [0,1]. turns: as LitPlane's.
float fade_of_square(const Scene& scene, const Light& light, const PolygonLight& square, const Vec3& point,
                     bool turns = false);

// The point or spot light that a square with these corners stands for; none: ~0u.
std::uint32_t punctual_of_corners(const Scene& scene, std::span<const Vec3> corners);

}  // namespace oriel
