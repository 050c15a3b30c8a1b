#include "bake/atlas/flatten.h"

#include <algorithm>
#include <vector>

#include "bake/atlas/lscm.h"
#include "formats/core/rectangle.h"

namespace oriel {
namespace {

constexpr double kIsometry = 1.005;  // L2 stretch of a projection beyond which a conformal map is better
constexpr double kFlatScale = 1e-4;  // a projection so near to scale is of something flat, and stays exact
constexpr double kLeastCos = 0.2;    // of a projected triangle's normal to the direction of projection
constexpr double kFlatRatio = 1e-9;  // twice the area over the longest side squared: a line, whatever its sign

// Axes in the plane: x horizontal, y up the slope; for a floor x along the world's x.
std::array<DVec3, 2> plane_axes(const DVec3& normal) {
  const DVec3 side = std::abs(normal.y) > 0.9 ? DVec3(normal.y < 0 ? -1 : 1, 0, 0) : glm::cross(DVec3(0, 1, 0), normal);
  const DVec3 x = glm::normalize(side - normal * glm::dot(side, normal));
  return {x, glm::cross(normal, x)};
}

// x and y of p along the direction d (unit) and its left normal.
DVec2 rotated(const DVec2& p, const DVec2& d) {
  return {glm::dot(p, d), cross2(d, p)};
}

// Turns points as their smallest box lies, or upright where that is hardly larger; its lowest corner to (0, 0); its
// size.
DVec2 turn_into_box(std::span<Triangle2> points) {
  std::vector<DVec2> all;
  all.reserve(3 * points.size());
  for (const Triangle2& t : points) all.insert(all.end(), t.begin(), t.end());
  const Rectangle box = tight_rectangle(all, DVec2(1, 0));
  const DVec2 size = box.upper - box.lower;
  for (Triangle2& t : points)
    for (DVec2& p : t) p = glm::clamp(rotated(p, box.axis) - box.lower, DVec2(0), size);
  return size;
}

std::vector<Triangle2> project(std::span<const Triangle3> corners, const DVec3& normal) {
  const auto [x_axis, y_axis] = plane_axes(normal);
  const DVec3 origin = corners[0][0];
  std::vector<Triangle2> points(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      points[i][k] = {glm::dot(corners[i][k] - origin, x_axis), glm::dot(corners[i][k] - origin, y_axis)};
  return points;
}

// Turns points in the plane so that they lie as their projection does: upright.
void align(std::span<const Triangle2> projected, std::span<Triangle2> points) {
  DVec2 sum(0);  // of the projection's sides over the points', as complex numbers: its angle is the mean turn
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const DVec2 from = points[i][(k + 1) % 3] - points[i][k], to = projected[i][(k + 1) % 3] - projected[i][k];
      sum += DVec2(glm::dot(from, to), cross2(to, from));
    }
  const double length = glm::length(sum);
  if (!(length > 0)) return;
  for (Triangle2& t : points)
    for (DVec2& p : t) p = rotated(p, sum / length);
}

StretchSum stretch_of(std::span<const Triangle3> corners, std::span<const Triangle2> points) {
  StretchSum sum;
  for (std::size_t i = 0; i < points.size(); ++i) sum.add(corners[i], points[i]);
  return sum;
}

// Scales the points so that the density of texels is right on average.
void keep_area(const StretchSum& stretch, std::span<Triangle2> points) {
  if (!(stretch.plane_area() > 0)) return;
  const double scale = std::sqrt(stretch.surface_area() / stretch.plane_area());
  if (std::abs(scale - 1) < kFlatScale) return;
  for (Triangle2& t : points)
    for (DVec2& p : t) p *= scale;
}

bool turns_over(const Triangle2& t) {
  const DVec2 e = t[1] - t[0], f = t[2] - t[1], g = t[0] - t[2];
  return 2 * signed_area(t) < -kFlatRatio * std::max({glm::dot(e, e), glm::dot(f, f), glm::dot(g, g)});
}

bool overlaps(const Patch& patch, std::span<const Triangle2> points, double length, double texel_m) {
  if (patch.size() <= 2) return false;  // two triangles that share an edge cannot, unless one is turned over
  bool turned_over = false;
  for (const Triangle2& t : points) turned_over |= signed_area(t) < 0;
  if (!turned_over && is_simple_outline(outline(patch, points))) return false;
  const OverlapTolerance tolerance{1e-4 * texel_m * texel_m, std::max(1e-6 * length, 1e-3 * texel_m)};
  return find_overlap(points, tolerance).has_value();
}

// True where no triangle is seen from its back or from too far aside.
bool faces_forward(std::span<const Triangle3> corners, const DVec3& axis) {
  for (const Triangle3& t : corners) {
    const DVec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
    const double length = glm::length(normal);
    if (length > 0 && !(glm::dot(normal, axis) > kLeastCos * length)) return false;
  }
  return true;
}

// The unit normal of all triangles together; +Y where they cancel.
DVec3 mean_normal(std::span<const Triangle3> corners) {
  DVec3 sum(0);
  for (const Triangle3& t : corners) sum += glm::cross(t[1] - t[0], t[2] - t[0]);
  const double length = glm::length(sum);
  return length > 0 ? sum / length : DVec3(0, 1, 0);
}

}  // namespace

std::optional<FlatChart> flatten(const Patch& patch, std::span<const Triangle3> corners, const FlattenLimits& limits) {
  const DVec3 axis = mean_normal(corners);
  std::vector<Triangle2> projected = project(corners, axis);
  const bool forward = patch.size() == 1 || faces_forward(corners, axis);
  const StretchSum stretch = stretch_of(corners, projected);
  const auto accept = [&](std::vector<Triangle2>& points) -> std::optional<FlatChart> {
    const DVec2 size = turn_into_box(points);
    double area = 0;
    for (const Triangle2& t : points) area += std::abs(signed_area(t));
    if (patch.size() > 2 && area > limits.large_m2 && area < limits.box_fill * size.x * size.y) return std::nullopt;
    if (overlaps(patch, points, size.x, limits.texel_m)) return std::nullopt;
    return FlatChart{patch.faces, std::move(points), size};
  };
  const bool isometric = patch.size() == 1 || !limits.conformal || stretch.l2() <= kIsometry;
  if (forward && isometric) {
    std::vector<Triangle2> points = projected;
    keep_area(stretch, points);
    if (auto chart = accept(points)) return chart;
  }
  if (!limits.conformal) return std::nullopt;
  std::vector<Triangle2> points = least_squares_conformal(patch, corners);
  if (!points.empty() && std::none_of(points.begin(), points.end(), turns_over)) {
    const StretchSum bent = stretch_of(corners, points);
    if (bent.l2() <= limits.l2 && bent.linf() <= limits.linf) {
      keep_area(bent, points);
      align(projected, points);
      if (auto chart = accept(points)) return chart;
    }
  }
  if (!forward || isometric || !(stretch.l2() <= limits.l2 && stretch.linf() <= limits.linf)) return std::nullopt;
  keep_area(stretch, projected);
  return accept(projected);
}

}  // namespace oriel
