#include "bake/import/repair.h"

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>

#include "formats/core/disjoint_sets.h"

namespace oriel {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Point = CGAL::Simple_cartesian<double>::Point_3;
using Triangle = std::array<std::size_t, 3>;

struct Edge {
  std::size_t low, high, triangle;
  bool same(const Edge& other) const { return low == other.low && high == other.high; }
  bool operator<(const Edge& other) const {
    return std::tie(low, high, triangle) < std::tie(other.low, other.high, other.triangle);
  }
};

struct ReversalCounter : pmp::Default_orientation_visitor {
  std::vector<char>* reversed = nullptr;
  void polygon_orientation_reversed(std::size_t triangle) { (*reversed)[triangle] ^= 1; }
};

std::size_t join_over_edges(const std::vector<Triangle>& triangles, DisjointSets& components) {
  std::vector<Edge> edges;
  edges.reserve(triangles.size() * 3);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(triangles[t][k], triangles[t][(k + 1) % 3]);
      edges.push_back({low, high, t});
    }
  std::sort(edges.begin(), edges.end());
  std::size_t non_manifold = 0;
  for (std::size_t first = 0, last = 0; first < edges.size(); first = last) {
    while (last < edges.size() && edges[last].same(edges[first])) ++last;
    if (last - first > 2) ++non_manifold;
    if (last - first == 2) components.join(edges[first].triangle, edges[first + 1].triangle);
  }
  return non_manifold;
}

}  // namespace

SoupReport inspect_soup(std::span<const Vec3> positions, std::span<const UVec3> triangles) {
  SoupReport report;
  std::vector<Point> points;
  std::vector<Triangle> soup;
  points.reserve(positions.size());
  soup.reserve(triangles.size());
  for (const Vec3& p : positions) points.emplace_back(p.x, p.y, p.z);
  for (const UVec3& t : triangles) soup.push_back({t.x, t.y, t.z});
  try {
    pmp::merge_duplicate_points_in_polygon_soup(points, soup);
    DisjointSets components(soup.size());
    report.non_manifold_edges = join_over_edges(soup, components);
    std::vector<char> reversed(soup.size());
    ReversalCounter counter;
    counter.reversed = &reversed;
    pmp::orient_polygon_soup(points, soup, CGAL::parameters::visitor(counter));
    // CGAL starts each component with its first triangle; the majority may face the other way.
    std::vector<std::size_t> total(soup.size()), turned(soup.size());
    for (std::size_t t = 0; t < soup.size(); ++t) {
      const std::size_t c = components.root(t);
      ++total[c];
      turned[c] += reversed[t] ? 1 : 0;
    }
    for (std::size_t c = 0; c < soup.size(); ++c)
      report.misoriented_triangles += std::min(turned[c], total[c] - turned[c]);
  } catch (const std::exception&) {
    // Only CGAL's own checks throw. The report is advice: what was found so far is all there is to say.
  }
  return report;
}

}  // namespace oriel
