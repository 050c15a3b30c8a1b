// The convex hull of points in a plane.
#pragma once

#include <algorithm>
#include <vector>

#include "formats/core/vec.h"

namespace oriel {

// The z of the cross product.
inline double cross2(const DVec2& a, const DVec2& b) {
  return a.x * b.y - a.y * b.x;
}

// Counter-clockwise, without collinear points; Andrew 1979, "Another efficient algorithm for convex hulls in two
// dimensions". Fewer than three points stay as they are.
inline std::vector<DVec2> convex_hull(std::vector<DVec2> points) {
  std::sort(points.begin(), points.end(),
            [](const DVec2& a, const DVec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<DVec2> hull;
  const auto extend = [&](const DVec2& p, std::size_t keep) {
    while (hull.size() >= keep + 2 && cross2(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0)
      hull.pop_back();
    hull.push_back(p);
  };
  for (const DVec2& p : points) extend(p, 0);
  const std::size_t lower = hull.size() - 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) extend(points[i], lower);
  hull.pop_back();
  return hull;
}

}  // namespace oriel
