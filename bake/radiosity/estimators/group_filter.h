// Smoothing of light by light group.
#pragma once

#include "bake/radiosity/estimators/direct_light.h"
#include "bake/radiosity/estimators/filter.h"
#include "bake/radiosity/gather/gather.h"
#include "bake/radiosity/texels/grouped_light.h"

namespace oriel {

// Two independent estimates of each group's light, as in Halves.
struct GroupHalves {
  std::array<GroupedLight, kHalves> light;
  bool steps = true;
};
// Filters each group's light by its own halves, as if only its lamps were lit: next to brighter light, the other light
// would decide what is noise in a faint group. The groups then do not sum to the filtered light of all any more, which
// rescale_groups() corrects.
GroupedLight filter_groups(const Texels& texels, const TexelGraph& graph, const GroupHalves& halves,
                           const FilterOptions& options, Context& context);
struct LightSums {
  const DirectSums& direct;
  const HalfSums& gathered;
};
// Filters direct and gathered light of each group in that way, and returns the sum. Errors of direct light are relative
// to the sum.
GroupedLight filter_groups(const Texels& texels, const TexelGraph& graph, const LightSums& sums,
                           const FilterOptions& options, Context& context);

// The noise of gathered light in a single hour over that of all light, both relative to the light shown: hours of a day
// are shown one at a time. It is measured by the unfiltered halves, as root mean squares over texels, weighted by
// importance, and over hours. At least 1; 1 without a day.
double noise_of_hours(const CacheQuery& query, std::span<const float> importance, const LightSums& sums);

}  // namespace oriel
