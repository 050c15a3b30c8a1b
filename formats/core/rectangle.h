// The rectangle that holds a planar set of points, and how much of a rectangle triangles cover.
#pragma once

#include <array>
#include <span>

#include "formats/core/vec.h"

namespace oriel {

struct Rectangle {
  DVec2 axis{1, 0};          // unit: the direction of the longer side
  DVec2 lower{0}, upper{0};  // bounds along axis and its left perpendicular
  double area() const { return (upper.x - lower.x) * (upper.y - lower.y); }
};

// Bounds of the points along `axis` (unit).
Rectangle bounds_along(std::span<const DVec2> points, const DVec2& axis);

// The tightest rectangle, a side of which lies on an edge of the convex hull (Freeman and Shapira 1975), or the one
// along `preferred` where that is no more than 2 % larger. Never empty for one point or more.
Rectangle tight_rectangle(std::span<const DVec2> points, const DVec2& preferred);

// Area of a triangle inside the axis-aligned rectangle [lower, upper].
double clipped_area(const std::array<DVec2, 3>& triangle, const DVec2& lower, const DVec2& upper);

}  // namespace oriel
