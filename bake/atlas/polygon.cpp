#include "bake/atlas/polygon.h"

#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace oriel {
namespace {

constexpr std::size_t kCrowd = 2048;      // triangles in a cell beyond which comparing all pairs takes too long
constexpr std::size_t kCrowdReach = 256;  // and how many each is then compared with

constexpr double kCellsAround = 16;  // that the mean triangle's sides may cross

// Cells about as large as the mean triangle's share of the bounds, or larger for slivers.
struct Grid {
  DVec2 lower{0};
  DVec2 cells_per_unit{0};
  int nx = 1, ny = 1;

  Triangle2 to_cells(const Triangle2& t) const {
    return {(t[0] - lower) * cells_per_unit, (t[1] - lower) * cells_per_unit, (t[2] - lower) * cells_per_unit};
  }
};

Grid make_grid(std::span<const Triangle2> triangles) {
  constexpr double kMax = std::numeric_limits<double>::max();
  DVec2 lower(kMax), upper(-kMax);
  double sides = 0;
  for (const Triangle2& t : triangles) {
    for (const DVec2& p : t) lower = glm::min(lower, p), upper = glm::max(upper, p);
    sides += glm::length(t[1] - t[0]) + glm::length(t[2] - t[1]) + glm::length(t[0] - t[2]);
  }
  Grid grid;
  grid.lower = lower;
  const DVec2 size = upper - lower;
  const auto n = static_cast<double>(triangles.size());
  const double longest = std::max(size.x, size.y);
  if (!(longest > 0)) return grid;
  const double cell =
      std::max({std::sqrt(size.x * size.y / n), longest / std::min(n, 4096.0), sides / n / kCellsAround});
  grid.nx = static_cast<int>(std::clamp(size.x / cell, 1.0, 4096.0));
  grid.ny = static_cast<int>(std::clamp(size.y / cell, 1.0, 4096.0));
  grid.cells_per_unit = {size.x > 0 ? grid.nx / size.x : 0, size.y > 0 ? grid.ny / size.y : 0};
  return grid;
}

template <class Visit>
void for_each_cell(const Grid& grid, const Triangle2& triangle, Visit&& visit) {
  for_each_row(grid.to_cells(triangle), grid.ny, [&](int y, const ConvexPolygon& part) {
    const Interval x = extent(part, 0);
    const CellRange columns = touched_cells(x.lo, x.hi, grid.nx);
    for (int c = columns.first; c <= columns.last; ++c) visit(static_cast<std::size_t>(y) * grid.nx + c);
  });
}

// The triangles that touch each cell, ascending.
class Cells {
 public:
  explicit Cells(std::span<const Triangle2> triangles) {
    const Grid grid = make_grid(triangles);
    first_.assign(static_cast<std::size_t>(grid.nx) * grid.ny + 1, 0);
    for (const Triangle2& t : triangles) for_each_cell(grid, t, [&](std::size_t cell) { ++first_[cell + 1]; });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    members_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t i = 0; i < triangles.size(); ++i)
      for_each_cell(grid, triangles[i],
                    [&](std::size_t cell) { members_[next[cell]++] = static_cast<std::uint32_t>(i); });
  }

  // Calls test(i, j), i < j, for pairs that share a cell (some more than once) until it returns true.
  template <class Test>
  bool any_pair(Test&& test) const {
    for (std::size_t cell = 0; cell + 1 < first_.size(); ++cell) {
      const std::size_t begin = first_[cell], end = first_[cell + 1];
      const std::size_t reach = end - begin > kCrowd ? kCrowdReach : end - begin;
      for (std::size_t i = begin; i < end; ++i)
        for (std::size_t j = i + 1; j < std::min(end, i + 1 + reach); ++j)
          if (test(members_[i], members_[j])) return true;
    }
    return false;
  }

 private:
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> members_;
};

Triangle2 counter_clockwise(const Triangle2& t) {
  return signed_area(t) >= 0 ? t : Triangle2{t[0], t[2], t[1]};
}

// True where an edge of a has all of b outside it, or inside by no more than the thickness. Both counter-clockwise.
bool separated(const Triangle2& a, const Triangle2& b, double thickness) {
  for (std::size_t i = 0; i < 3; ++i) {
    const DVec2 edge = a[(i + 1) % 3] - a[i];
    const double limit = thickness * glm::length(edge);
    if (cross2(edge, b[0] - a[i]) <= limit && cross2(edge, b[1] - a[i]) <= limit && cross2(edge, b[2] - a[i]) <= limit)
      return true;
  }
  return false;
}

// The part of the polygon to the left of the line from a to b.
ConvexPolygon clip_line(const ConvexPolygon& polygon, const DVec2& a, const DVec2& b) {
  ConvexPolygon out;
  const DVec2 edge = b - a;
  for (int i = 0; i < polygon.count; ++i) {
    const DVec2& p = polygon.at(i);
    const DVec2& q = polygon.at((i + 1) % polygon.count);
    const double dp = cross2(edge, p - a), dq = cross2(edge, q - a);
    if (dp >= 0) out.add(p);
    if ((dp > 0 && dq < 0) || (dp < 0 && dq > 0)) out.add(p + (q - p) * (dp / (dp - dq)));
  }
  return out;
}

// True where the closed segments have a point in common, or cannot be told apart from such by their signs.
bool meet(const OutlineEdge& e, const OutlineEdge& f) {
  for (int axis = 0; axis < 2; ++axis)
    if (std::max(e.a[axis], e.b[axis]) < std::min(f.a[axis], f.b[axis]) ||
        std::max(f.a[axis], f.b[axis]) < std::min(e.a[axis], e.b[axis]))
      return false;
  const auto one_side = [](const OutlineEdge& line, const OutlineEdge& other) {
    const double p = cross2(line.b - line.a, other.a - line.a), q = cross2(line.b - line.a, other.b - line.a);
    return (p > 0 && q > 0) || (p < 0 && q < 0);
  };
  return !one_side(e, f) && !one_side(f, e);
}

// Loops with a positive area.
std::size_t positive_loops(std::span<const OutlineEdge> edges) {
  std::vector<bool> seen(edges.size());
  std::size_t count = 0;
  for (std::size_t start = 0; start < edges.size(); ++start) {
    double twice_area = 0;
    for (std::size_t i = start; !seen[i]; i = edges[i].next) {
      seen[i] = true;
      twice_area += cross2(edges[i].a - edges[start].a, edges[i].b - edges[start].a);
    }
    count += twice_area > 0;
  }
  return count;
}

std::optional<Overlap> overlap_of(const Triangle2& a, const Triangle2& b, const OverlapTolerance& tolerance) {
  for (int axis = 0; axis < 2; ++axis) {
    const auto [a_lo, a_hi] = std::minmax({a[0][axis], a[1][axis], a[2][axis]});
    const auto [b_lo, b_hi] = std::minmax({b[0][axis], b[1][axis], b[2][axis]});
    if (a_hi <= b_lo || b_hi <= a_lo) return std::nullopt;
  }
  const Triangle2 first = counter_clockwise(a), second = counter_clockwise(b);
  if (separated(first, second, tolerance.thickness) || separated(second, first, tolerance.thickness))
    return std::nullopt;
  ConvexPolygon common(first);
  for (std::size_t i = 0; i < 3 && common.count > 0; ++i) common = clip_line(common, second[i], second[(i + 1) % 3]);
  const double common_area = area(common);
  const double smaller = std::min(signed_area(first), signed_area(second));
  if (!(common_area > std::min(tolerance.area, 0.1 * smaller))) return std::nullopt;
  Overlap result;
  for (int i = 0; i < common.count; ++i) result.where += common.at(i) / static_cast<double>(common.count);
  result.area = common_area;
  return result;
}

}  // namespace

double area(const ConvexPolygon& polygon) {
  double twice = 0;
  for (int i = 2; i < polygon.count; ++i)
    twice += cross2(polygon.at(i - 1) - polygon.at(0), polygon.at(i) - polygon.at(0));
  return 0.5 * std::abs(twice);
}

ConvexPolygon clip_axis(const ConvexPolygon& polygon, int axis, double limit, double sign) {
  ConvexPolygon out;
  for (int i = 0; i < polygon.count; ++i) {
    const DVec2& p = polygon.at(i);
    const DVec2& q = polygon.at(i + 1 == polygon.count ? 0 : i + 1);
    const double dp = sign * (p[axis] - limit), dq = sign * (q[axis] - limit);
    if (dp >= 0) out.add(p);
    if ((dp > 0 && dq < 0) || (dp < 0 && dq > 0)) {
      DVec2 cut = p + (q - p) * (dp / (dp - dq));
      cut[axis] = limit;
      out.add(cut);
    }
  }
  return out;
}

ConvexPolygon clip_to_cell(const Triangle2& triangle, double x, double y) {
  ConvexPolygon part = clip_axis(clip_axis(ConvexPolygon(triangle), 0, x, 1), 0, x + 1, -1);
  return clip_axis(clip_axis(part, 1, y, 1), 1, y + 1, -1);
}

Interval extent(const ConvexPolygon& polygon, int axis) {
  Interval e{polygon.at(0)[axis], polygon.at(0)[axis]};
  for (int i = 1; i < polygon.count; ++i) {
    e.lo = std::min(e.lo, polygon.at(i)[axis]);
    e.hi = std::max(e.hi, polygon.at(i)[axis]);
  }
  return e;
}

bool is_simple_outline(std::span<const OutlineEdge> edges) {
  if (positive_loops(edges) != 1) return false;
  std::vector<Triangle2> lines;
  lines.reserve(edges.size());
  for (const OutlineEdge& e : edges) lines.push_back({e.a, e.b, e.b});
  const Cells cells(lines);
  return !cells.any_pair([&](std::uint32_t i, std::uint32_t j) {
    return edges[i].next != j && edges[j].next != i && meet(edges[i], edges[j]);
  });
}

std::optional<Overlap> find_overlap(std::span<const Triangle2> triangles, const OverlapTolerance& tolerance) {
  if (triangles.size() < 2) return std::nullopt;
  std::optional<Overlap> found;
  const Cells cells(triangles);
  cells.any_pair([&](std::uint32_t i, std::uint32_t j) {
    found = overlap_of(triangles[i], triangles[j], tolerance);
    if (found) found->a = i, found->b = j;
    return found.has_value();
  });
  return found;
}

}  // namespace oriel
