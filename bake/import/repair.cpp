#include "bake/import/repair.h"

#include "bake/scene/edges.h"
#include "formats/core/disjoint_sets.h"

namespace oriel {

SoupReport inspect_soup(std::span<const std::uint32_t> corners) {
  SoupReport report;
  // Of triangle t as it is, 2 t, and turned, 2 t + 1: a set faces one way.
  DisjointSets facing(corners.size() / 3 * 2);
  for_each_edge(edge_uses(corners), [&](std::span<const EdgeUse> uses) {
    if (uses.size() > 2) ++report.non_manifold_edges;
    if (uses.size() != 2) return;
    const std::size_t a = uses[0].corner / 3 * 2, b = uses[1].corner / 3 * 2, odd = uses[0].forward == uses[1].forward;
    if (facing.root(a) == facing.root(b + 1 - odd)) return;  // a strip with a twist: it is cut here
    facing.join(a, b + odd);
    facing.join(a + 1, b + 1 - odd);
  });
  std::vector<std::size_t> total(corners.size() / 3), turned(corners.size() / 3);
  for (std::size_t t = 0; t < total.size(); ++t) {
    const std::size_t first = facing.root(2 * t);
    ++total[first / 2];
    turned[first / 2] += first % 2;
  }
  for (std::size_t c = 0; c < total.size(); ++c)
    report.misoriented_triangles += std::min(turned[c], total[c] - turned[c]);
  return report;
}

}  // namespace oriel
