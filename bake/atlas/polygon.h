// Convex polygons in the plane of a chart or a page: clipping, area, rows, and the search for overlapping triangles.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>

#include "formats/core/check.h"
#include "formats/core/convex_hull.h"
#include "formats/core/vec.h"

namespace oriel {

using Triangle2 = std::array<DVec2, 3>;

// A convex polygon of few vertices: a triangle cut by at most four lines has seven.
struct ConvexPolygon {
  std::array<DVec2, 16> p;
  int count = 0;

  ConvexPolygon() = default;
  explicit ConvexPolygon(const Triangle2& t) : count(3) { std::copy(t.begin(), t.end(), p.begin()); }
  void add(const DVec2& v) {
    ORIEL_CHECK_LT(count, 16);
    p[static_cast<std::size_t>(count++)] = v;
  }
  const DVec2& at(int i) const { return p[static_cast<std::size_t>(i)]; }
};

// Positive for counter-clockwise in (x, y).
inline double signed_area(const Triangle2& t) {
  return 0.5 * cross2(t[1] - t[0], t[2] - t[0]);
}
double area(const ConvexPolygon& polygon);  // >= 0

// The part where p[axis] >= limit (sign = +1) or <= limit (sign = -1). New vertices lie on the limit exactly.
ConvexPolygon clip_axis(const ConvexPolygon& polygon, int axis, double limit, double sign);

// The part inside the unit square whose lowest corner is (x, y).
ConvexPolygon clip_to_cell(const Triangle2& triangle, double x, double y);

// The unit cells from first to last (inclusive) that an interval with lo <= hi touches by more than a point; an
// interval of no length touches one. Clamped to [0, count).
struct CellRange {
  int first = 0, last = 0;
};
inline CellRange touched_cells(double lo, double hi, int count) {
  const double top = count - 1;
  const double first = std::clamp(std::floor(lo), 0.0, top);
  return {static_cast<int>(first), static_cast<int>(std::clamp(std::ceil(hi) - 1, first, top))};
}

struct Interval {
  double lo = 0, hi = 0;
};
Interval extent(const ConvexPolygon& polygon, int axis);

// Calls visit(row, part) for each unit row of [0, rows), and of `window`, that the triangle touches, with the part of
// it in that row. Every row between the triangle's lowest and highest point is visited, however thin the triangle.
template <class Visit>
void for_each_row_between(const Triangle2& triangle, int rows, const CellRange& window, Visit&& visit) {
  const ConvexPolygon whole(triangle);
  const Interval y = extent(whole, 1);
  const CellRange touched = touched_cells(y.lo, y.hi, rows);
  for (int row = std::max(touched.first, window.first); row <= std::min(touched.last, window.last); ++row) {
    ConvexPolygon part = clip_axis(clip_axis(whole, 1, row, 1), 1, row + 1, -1);
    if (part.count == 0) part = whole;  // outside [0, rows) by rounding: the clamped row takes all of it
    visit(row, part);
  }
}
template <class Visit>
void for_each_row(const Triangle2& triangle, int rows, Visit&& visit) {
  for_each_row_between(triangle, rows, {0, rows - 1}, std::forward<Visit>(visit));
}

// What counts as an overlap: a common part thicker than `thickness` and larger than `area`, or than a tenth of the
// smaller triangle where that is less. In the units of the points and their square.
struct OverlapTolerance {
  double area = 0, thickness = 0;
};
struct Overlap {
  std::uint32_t a = 0, b = 0;  // indices of the triangles, a < b
  DVec2 where{0};              // a point of the common part
  double area = 0;
};

// Some pair of triangles with a common part, the same one in every run; none where there is no such pair. Winding
// does not matter. Triangles thinner than the thickness overlap nothing. Where more than 2048 triangles meet in one
// cell of the search grid (the tip of a cone), each is compared with the next 256 there.
std::optional<Overlap> find_overlap(std::span<const Triangle2> triangles, const OverlapTolerance& tolerance);

// A directed edge of a closed outline.
struct OutlineEdge {
  DVec2 a{0}, b{0};
  std::uint32_t next = 0;  // the edge that goes on from b
};

// True where no two edges meet except each with its next, and exactly one loop runs counter-clockwise: the outline then
// winds once around what it encloses. So a chart without turned-over triangles does not overlap itself: the
// triangles over a point are as many as its outline winds around the point. False may also mean that it only touches
// itself.
bool is_simple_outline(std::span<const OutlineEdge> edges);

}  // namespace oriel
