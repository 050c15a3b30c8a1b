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

bool bound(LightPatch& patch, const DVec3& most) {
  constexpr double kAllLight = 1 + 1e-6;  // of the light, with a margin for rounding
  const DVec3 sum = weight_sum(patch);
  if (!glm::any(glm::greaterThan(sum, kAllLight * most))) return false;
  const Vec3 share(glm::min(most / glm::max(sum, DVec3(1e-30)), DVec3(1)));
  for (PatchLink& link : patch.links) link.weight *= share;
  return true;
}

void fill_untraced(std::span<const LightPatch> patches, std::vector<Vec3>& light) {
  DVec3 sum(0);
  double area = 0;
  for (std::size_t p = 0; p < patches.size(); ++p)
    if (patches[p].traced) sum += patches[p].area_m2 * DVec3(light[p]), area += patches[p].area_m2;
  for (std::size_t p = 0; p < patches.size() && area > 0; ++p)
    if (!patches[p].traced) light[p] = Vec3(sum / area);
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
