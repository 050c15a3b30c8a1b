// Smoothing of the light of groups of lamps.
#pragma once

#include "bake/radiosity/estimators/filter.h"
#include "bake/radiosity/texels/booked.h"

namespace oriel {

// Filters each group's light by its own halves, as if its lamps shone alone: beside brighter light, what is noise of a
// faint group and what is its light would be told by the other's. The groups do not sum to the filtered light of all
// any more; share_out() sees to that. steps: as Halves'.
BookedLight filter_groups(const Texels& texels, const TexelGraph& graph, const std::array<BookedLight, kHalves>& halves,
                          const FilterOptions& options, Context& context, bool steps = true);

}  // namespace oriel
