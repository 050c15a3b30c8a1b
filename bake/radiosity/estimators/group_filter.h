// Smoothing of the light of groups of lamps.
#pragma once

#include "bake/radiosity/estimators/direct_light.h"
#include "bake/radiosity/estimators/filter.h"
#include "bake/radiosity/gather/gather.h"
#include "bake/radiosity/texels/grouped_light.h"

namespace oriel {

// Two estimates of the light of each group, as Halves.
struct GroupHalves {
  std::array<GroupedLight, kHalves> light;
  bool steps = true;
};
// Filters each group's light by its own halves, as if its lamps shone alone: beside brighter light, what is noise of a
// faint group and what is its light would be told by the other's. The groups do not sum to the filtered light of all
// any more; rescale_groups() sees to that.
GroupedLight filter_groups(const Texels& texels, const TexelGraph& graph, const GroupHalves& halves,
                           const FilterOptions& options, Context& context);
struct LightSums {
  const DirectSums& direct;
  const HalfSums& gathered;
};
// Direct and gathered light of each group, filtered so and added up; direct light beside what the group gathers, as
// that of all is.
GroupedLight filter_groups(const Texels& texels, const TexelGraph& graph, const LightSums& sums,
                           const FilterOptions& options, Context& context);

// Hours of the scene's day are seen one at a time. How much noisier gathered light of theirs is than that of all,
// relative to all that the hour or they have, by what the halves differ by before the filter: root mean squares over
// texels by their share of frames, and over hours; 1 at least, and without a day.
double noise_of_hours(const CacheQuery& query, std::span<const float> importance, const LightSums& sums);

}  // namespace oriel
