// Charts laid flat.
#pragma once

#include <span>

#include "bake/atlas/polygon.h"
#include "bake/scene/scene.h"

namespace oriel {

// Projects triangles along `normal` (unit) onto a plane: isometric for a flat chart, and shrunk by the cosine of the
// angle across a slope. Points are in metres, counter-clockwise for triangles seen from their front, turned so that the
// chart's bounding box is small (upright, with world +Y towards smaller y, where that is about as small) and wider than
// high, its lowest corner at (0, 0). Returns the box's size. points.size() == triangles.size().
DVec2 flatten(const Scene& scene, std::span<const std::uint32_t> triangles, const DVec3& normal,
              std::span<Triangle2> points);

}  // namespace oriel
