#include "bake/import/repair.h"

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Simple_cartesian.h>

#include <array>

#include "bake/scene/edges.h"
#include "formats/core/disjoint_sets.h"

namespace oriel {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Point = CGAL::Simple_cartesian<double>::Point_3;

struct ReversalCounter : pmp::Default_orientation_visitor {
  std::vector<char>* reversed = nullptr;
  void polygon_orientation_reversed(std::size_t triangle) { (*reversed)[triangle] ^= 1; }
};

}  // namespace

SoupReport inspect_soup(std::span<const std::uint32_t> corners) {
  SoupReport report;
  std::vector<std::array<std::size_t, 3>> soup;
  for (std::size_t t = 0; t + 2 < corners.size(); t += 3) soup.push_back({corners[t], corners[t + 1], corners[t + 2]});
  DisjointSets components(soup.size());
  for_each_edge(edge_uses(corners), [&](std::span<const EdgeUse> uses) {
    if (uses.size() > 2) ++report.non_manifold_edges;
    if (uses.size() == 2) components.join(uses[0].corner / 3, uses[1].corner / 3);
  });
  std::vector<char> reversed(soup.size());
  ReversalCounter counter;
  counter.reversed = &reversed;
  try {
    std::vector<Point> places(corners.empty() ? 0 : std::ranges::max(corners) + std::size_t{1});  // CGAL asks for none
    pmp::orient_polygon_soup(places, soup, CGAL::parameters::visitor(counter));
  } catch (const std::exception&) {
    return report;  // only CGAL's own checks throw; the report is advice
  }
  // CGAL starts each component with its first triangle; the majority may face the other way.
  std::vector<std::size_t> total(soup.size()), turned(soup.size());
  for (std::size_t t = 0; t < soup.size(); ++t) {
    const std::size_t c = components.root(t);
    ++total[c];
    turned[c] += reversed[t] ? 1 : 0;
  }
  for (std::size_t c = 0; c < soup.size(); ++c)
    report.misoriented_triangles += std::min(turned[c], total[c] - turned[c]);
  return report;
}

}  // namespace oriel
