// Surfaces that are copies of each other, so that their charts are.
#pragma once

#include <span>
#include <vector>

#include "bake/atlas/texel_demand.h"
#include "bake/scene/scene.h"

namespace oriel {

// By entry of `surfaces`: the first entry that is congruent with it, moved and turned but not scaled, or itself. Only
// those that lie in one ring of the demand each have others; demand may be null.
std::vector<std::uint32_t> first_congruent(const Scene& scene, std::span<const std::uint32_t> surfaces,
                                           const TexelDemand* demand);

}  // namespace oriel
