// Edges at which no chart goes on.
#pragma once

#include <vector>

#include "bake/atlas/texel_demand.h"
#include "bake/scene/scene.h"

namespace oriel {

// Parts triangles of a surface that lie in two rings of the demand (null: there are none) or on two sides of a wall
// (Scene::cuts). across: as edges_across() gives it.
void end_charts(const Scene& scene, const Surface& surface, const TexelDemand* demand,
                std::vector<std::uint32_t>& across);

}  // namespace oriel
