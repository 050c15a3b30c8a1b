// The sun as a lamp that glossy reflectors show.
#pragma once

#include <optional>

#include "bake/trace/polygon_light.h"

namespace oriel {

// A square far beyond the scene with the solid angle, direction and irradiance of a directional light's disk; of one
// without a disk 0.1° across. Nothing for other lights, for black ones, and for disks wider than 20°, whose shape would
// show. It has no triangles of the scene.
std::optional<PolygonLight> sun_polygon(const Scene& scene, const Light& light);

// The directional light that a square with these corners stands for; none: ~0u.
std::uint32_t sun_of_corners(const Scene& scene, const std::vector<Vec3>& corners);

}  // namespace oriel
