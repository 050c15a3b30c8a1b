#include "player/movers/shade_cells.h"

#include <limits>
#include <queue>

namespace oriel {
namespace {

constexpr double kMargin = 1e-4;        // of the scene's radius
constexpr double kCellRounding = 1e-6;  // of its largest coordinate
constexpr float kFewestMargins = 16;    // that a side which is split is long
constexpr float kConeMargin = 1e-5f;    // of the cosine
constexpr float kInfinity = std::numeric_limits<float>::infinity();

Bounds around(const std::array<Vec3, 3>& corners) {
  Bounds box;
  for (const Vec3& corner : corners) box.extend(corner);
  return box;
}

Bounds widened(const Bounds& box, float by) {
  return {box.lower - by, box.upper + by};
}

bool holds(const Bounds& box, const Bounds& inner) {
  return glm::all(glm::lessThanEqual(box.lower, inner.lower)) && glm::all(glm::lessThanEqual(inner.upper, box.upper));
}

int longest_axis(const Vec3& size) {
  return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

// Convex; each of six planes adds one corner at most.
struct Polygon {
  std::array<Vec3, 9> corners;
  std::size_t size = 0;
};

// What lies where sign · p[axis] <= sign · at.
Polygon cut(const Polygon& in, int axis, float at, float sign) {
  Polygon out;
  for (std::size_t i = 0; i < in.size; ++i) {
    const Vec3 &a = in.corners[i], &b = in.corners[i + 1 < in.size ? i + 1 : 0];
    const float da = sign * (a[axis] - at), db = sign * (b[axis] - at);
    if (da <= 0 && out.size < out.corners.size()) out.corners[out.size++] = a;
    if ((da <= 0) != (db <= 0) && out.size < out.corners.size())
      out.corners[out.size++] = a + (b - a) * (da / (da - db));
  }
  return out;
}

Bounds clipped(const std::array<Vec3, 3>& corners, const Bounds& box) {
  Polygon polygon;
  for (const Vec3& corner : corners) polygon.corners[polygon.size++] = corner;
  const Bounds own = around(corners);
  for (int axis = 0; axis < 3; ++axis) {
    if (own.lower[axis] < box.lower[axis]) polygon = cut(polygon, axis, box.lower[axis], -1);
    if (own.upper[axis] > box.upper[axis]) polygon = cut(polygon, axis, box.upper[axis], 1);
  }
  Bounds out;
  for (std::size_t i = 0; i < polygon.size; ++i) out.extend(polygon.corners[i]);
  return out;
}

class CellSplitter {
 public:
  explicit CellSplitter(std::span<const ShadeTriangle> triangles) : triangles_(triangles) {
    normals_.resize(triangles.size());
    Bounds all;
    std::vector<std::uint32_t> kept;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
      if (!find_normals(i)) continue;
      kept.push_back(i);
      all.extend(around(triangles[i].corners));
    }
    if (!kept.empty()) {
      const double largest = max_component(glm::max(glm::abs(all.lower), glm::abs(all.upper)));
      const double radius = 0.5 * glm::length(DVec3(all.upper) - DVec3(all.lower));
      margin_ = static_cast<float>(kMargin * radius + kCellRounding * largest);
    }
    add({Vec3(-kInfinity), Vec3(kInfinity)}, kept);
  }

  std::vector<ShadeCell> split(const ShadeCellLimits& limits) {
    const float smallest = std::max(limits.smallest_m, kFewestMargins * margin_);
    for (std::size_t leaves = 1; leaves < limits.most && !open_.empty();) {
      const std::uint32_t index = open_.top().second;
      open_.pop();
      const Vec3 size = cells_[index].content.upper - cells_[index].content.lower;
      const int axis = longest_axis(size);
      if (!(size[axis] > smallest)) continue;
      split(index, axis);
      ++leaves;
    }
    return std::move(cells_);
  }

 private:
  // False where the triangle is left out.
  bool find_normals(std::uint32_t i) {
    const ShadeTriangle& t = triangles_[i];
    for (const Vec3& corner : t.corners)
      if (!is_finite(corner)) return false;
    const DVec3 a(t.corners[0]), cross = glm::cross(DVec3(t.corners[1]) - a, DVec3(t.corners[2]) - a);
    const double length = glm::length(cross);
    if (!(length > 0 && std::isfinite(length))) return false;
    normals_[i][3] = Vec3(cross / length);
    for (std::size_t k = 0; k < 3; ++k) normals_[i][k] = normalize_or(t.normals[k], normals_[i][3]);
    return true;
  }

  // candidates: all that lie in the cell, and others.
  void add(const Bounds& box, const std::vector<std::uint32_t>& candidates) {
    ShadeCell cell;
    cell.cell = box;
    std::vector<std::uint32_t> kept;
    const Bounds wide = widened(box, margin_);
    for (const std::uint32_t i : candidates) {
      const Bounds own = around(triangles_[i].corners);
      const Bounds part = holds(wide, own) ? own : clipped(triangles_[i].corners, wide);
      if (part.empty()) continue;
      cell.content.extend(part);
      kept.push_back(i);
    }
    if (!kept.empty()) {
      cell.content = widened(cell.content, margin_);
      find_cone(kept, cell);
      open_.push({cell.content.radius(), static_cast<std::uint32_t>(cells_.size())});
    }
    cells_.push_back(cell);
    inside_.push_back(std::move(kept));
  }

  void find_cone(const std::vector<std::uint32_t>& inside, ShadeCell& cell) const {
    Bounds box;
    for (const std::uint32_t i : inside) {
      if (triangles_[i].two_sided) return;
      for (const Vec3& normal : normals_[i]) box.extend(normal);
    }
    const Vec3 axis = normalize_or(box.center(), Vec3(0));
    if (axis == Vec3(0)) return;
    float least = 1;
    for (const std::uint32_t i : inside)
      for (const Vec3& normal : normals_[i]) least = std::min(least, glm::dot(axis, normal));
    if (!(least > kConeMargin)) return;  // a wider cone need not hold what lies between its directions
    cell.axis = axis;
    cell.cos_spread = least - kConeMargin;
  }

  void split(std::uint32_t index, int axis) {
    Bounds first = cells_[index].cell, second = first;
    first.upper[axis] = second.lower[axis] = cells_[index].content.center()[axis];
    cells_[index].child = static_cast<std::uint32_t>(cells_.size());
    const std::vector<std::uint32_t> inside = std::move(inside_[index]);
    add(first, inside);
    add(second, inside);
  }

  std::span<const ShadeTriangle> triangles_;
  std::vector<std::array<Vec3, 4>> normals_;  // unit: the corners' and the triangle's own
  float margin_ = 0;                          // metres
  std::vector<ShadeCell> cells_;
  std::vector<std::vector<std::uint32_t>> inside_;             // by cell: triangles; none once it is split
  std::priority_queue<std::pair<float, std::uint32_t>> open_;  // half diagonals, and cells
};

}  // namespace

std::vector<ShadeCell> make_shade_cells(std::span<const ShadeTriangle> triangles, const ShadeCellLimits& limits) {
  return CellSplitter(triangles).split(limits);
}

}  // namespace oriel
