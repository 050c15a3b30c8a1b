#include "bake/radiosity/estimators/patch_list.h"

#include <algorithm>
#include <numeric>

namespace oriel {

std::vector<std::uint32_t> connect_blocks(const Texels& t, const TexelGraph& graph, std::uint32_t side) {
  std::vector<std::uint32_t> parent(t.count());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (std::uint32_t i = 0; i < parent.size(); ++i)
    for (const std::uint32_t j : graph.of(i))
      if (same_chart(t, i, j) && t.x[i] / side == t.x[j] / side && t.y[i] / side == t.y[j] / side)
        parent[root(i)] = root(j);
  for (std::uint32_t i = 0; i < parent.size(); ++i) parent[i] = root(i);
  return parent;
}

void join_links(std::vector<PatchLink>& links) {
  std::stable_sort(links.begin(), links.end(),
                   [](const PatchLink& a, const PatchLink& b) { return a.patch < b.patch; });
  std::size_t merged = 0;
  for (std::size_t i = 0; i < links.size(); ++i)
    if (merged > 0 && links[merged - 1].patch == links[i].patch)
      links[merged - 1].weight += links[i].weight;
    else
      links[merged++] = links[i];
  links.resize(merged);
  links.shrink_to_fit();
}

}  // namespace oriel
