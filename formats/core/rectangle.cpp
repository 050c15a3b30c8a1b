#include "formats/core/rectangle.h"

#include <algorithm>

#include "formats/core/convex_hull.h"

namespace oriel {
namespace {

constexpr double kPreferredSlack = 1.02;  // the preferred rectangle may be so much larger than the smallest
constexpr std::size_t kMaxSides = 64;     // of the hull, the longest, are tried: a finer one is round, and any will do

// Keeps the part of a polygon where sign * coordinate <= sign * limit.
std::vector<DVec2> clip(const std::vector<DVec2>& polygon, int axis, double sign, double limit) {
  std::vector<DVec2> out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const DVec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double da = sign * (limit - a[axis]), db = sign * (limit - b[axis]);
    if (da >= 0) out.push_back(a);
    if ((da >= 0) != (db >= 0)) out.push_back(a + (b - a) * (da / (da - db)));
  }
  return out;
}

}  // namespace

Rectangle bounds_along(std::span<const DVec2> points, const DVec2& axis) {
  const DVec2 left(-axis.y, axis.x);
  Rectangle r{.axis = axis};
  bool first = true;
  for (const DVec2& p : points) {
    const DVec2 q(glm::dot(p, axis), glm::dot(p, left));
    r.lower = first ? q : glm::min(r.lower, q);
    r.upper = first ? q : glm::max(r.upper, q);
    first = false;
  }
  return r;
}

Rectangle tight_rectangle(std::span<const DVec2> points, const DVec2& preferred) {
  const std::vector<DVec2> hull = convex_hull({points.begin(), points.end()});
  std::vector<DVec2> sides;
  for (std::size_t i = 0; i < hull.size(); ++i) sides.push_back(hull[(i + 1) % hull.size()] - hull[i]);
  std::stable_sort(sides.begin(), sides.end(),
                   [](const DVec2& a, const DVec2& b) { return glm::dot(a, a) > glm::dot(b, b); });
  sides.resize(std::min(sides.size(), kMaxSides));
  Rectangle best = bounds_along(hull, preferred);
  double least = best.area() / kPreferredSlack;
  for (const DVec2& side : sides) {
    const double length = glm::length(side);
    if (!(length > 0)) continue;
    const Rectangle r = bounds_along(hull, side / length);
    if (r.area() < least * (1 - 1e-5)) best = r, least = r.area();
  }
  if (best.upper.y - best.lower.y > (best.upper.x - best.lower.x) * (1 + 1e-6))  // a square stays as it is
    best = bounds_along(hull, DVec2(-best.axis.y, best.axis.x));
  return best;
}

double clipped_area(const std::array<DVec2, 3>& triangle, const DVec2& lower, const DVec2& upper) {
  std::vector<DVec2> polygon(triangle.begin(), triangle.end());
  for (int axis = 0; axis < 2 && !polygon.empty(); ++axis) {
    polygon = clip(polygon, axis, 1, upper[axis]);
    polygon = clip(polygon, axis, -1, lower[axis]);
  }
  double twice = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i)
    twice += cross2(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return 0.5 * std::abs(twice);
}

}  // namespace oriel
