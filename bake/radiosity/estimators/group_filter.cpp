#include "bake/radiosity/estimators/group_filter.h"

namespace oriel {

BookedLight filter_groups(const Texels& texels, const TexelGraph& graph, const std::array<BookedLight, kHalves>& halves,
                          const FilterOptions& options, Context& context, bool steps) {
  BookedLight out = halves[0];
  const std::vector<Vec3> none(texels.count(), Vec3(0));
  for (std::size_t g = 0; g < out.groups; ++g) {
    if (halves[0].is_dark(g) && halves[1].is_dark(g)) continue;
    const Halves own{{halves[0].of_group(g), halves[1].of_group(g)}, none, none, steps};
    out.set_group(g, filter(texels, graph, own, options, context).value);
  }
  return out;
}

}  // namespace oriel
