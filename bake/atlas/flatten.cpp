#include "bake/atlas/flatten.h"

#include <algorithm>
#include <vector>

namespace oriel {
namespace {

constexpr double kUprightSlack = 1.02;  // an upright box may be so much larger than the smallest
constexpr std::size_t kMaxSides = 64;   // of the hull, the longest, are tried as a side of the box

// Axes in the plane: x horizontal, y up the slope; for a floor x along the world's x.
std::array<DVec3, 2> plane_axes(const DVec3& normal) {
  const DVec3 side = std::abs(normal.y) > 0.9 ? DVec3(normal.y < 0 ? -1 : 1, 0, 0) : glm::cross(DVec3(0, 1, 0), normal);
  const DVec3 x = glm::normalize(side - normal * glm::dot(side, normal));
  return {x, glm::cross(normal, x)};
}

// Counter-clockwise convex hull; Andrew 1979, "Another efficient algorithm for convex hulls in two dimensions".
std::vector<DVec2> convex_hull(std::vector<DVec2> points) {
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

// x and y of p along the direction d (unit) and its left normal.
DVec2 rotated(const DVec2& p, const DVec2& d) {
  return {glm::dot(p, d), cross2(d, p)};
}

struct Box {
  DVec2 lower{0}, size{0};
  double cost() const { return size.x * size.y; }
};

Box box_along(std::span<const DVec2> hull, const DVec2& direction) {
  DVec2 lower = rotated(hull[0], direction), upper = lower;
  for (const DVec2& p : hull) {
    const DVec2 q = rotated(p, direction);
    lower = glm::min(lower, q), upper = glm::max(upper, q);
  }
  return {lower, upper - lower};
}

// The direction of the box's x axis: one side of the smallest box lies along the hull (Freeman and Shapira 1975).
DVec2 best_direction(std::span<const DVec2> hull) {
  std::vector<DVec2> sides;
  for (std::size_t i = 0; i < hull.size(); ++i) sides.push_back(hull[(i + 1) % hull.size()] - hull[i]);
  std::stable_sort(sides.begin(), sides.end(),
                   [](const DVec2& a, const DVec2& b) { return glm::dot(a, a) > glm::dot(b, b); });
  sides.resize(std::min(sides.size(), kMaxSides));
  DVec2 best(1, 0);
  double best_cost = box_along(hull, best).cost() / kUprightSlack;
  for (const DVec2& side : sides) {
    const double length = glm::length(side);
    if (!(length > 0)) continue;
    const double cost = box_along(hull, side / length).cost();
    if (cost < best_cost * (1 - 1e-9)) best = side / length, best_cost = cost;
  }
  return best;
}

}  // namespace

DVec2 flatten(const Scene& scene, std::span<const std::uint32_t> triangles, const DVec3& normal,
              std::span<Triangle2> points) {
  const auto [x_axis, y_axis] = plane_axes(normal);
  const DVec3 origin(scene.positions[scene.triangles[triangles[0]].x]);
  std::vector<DVec2> all;
  all.reserve(3 * triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const DVec3 p = DVec3(scene.positions[scene.triangles[triangles[i]][k]]) - origin;
      const DVec2 flat(glm::dot(p, x_axis), glm::dot(p, y_axis));
      points[i][static_cast<std::size_t>(k)] = flat;
      all.push_back(flat);
    }
  }
  const std::vector<DVec2> hull = convex_hull(std::move(all));
  DVec2 direction = best_direction(hull);
  Box box = box_along(hull, direction);
  if (box.size.y > box.size.x) {
    direction = {-direction.y, direction.x};
    box = box_along(hull, direction);
  }
  for (Triangle2& t : points)
    for (DVec2& p : t) p = glm::clamp(rotated(p, direction) - box.lower, DVec2(0), box.size);
  return box.size;
}

}  // namespace oriel
