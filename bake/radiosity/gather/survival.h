// Russian roulette at specular layers: the survival probability of gather paths.
#pragma once

#include "bake/radiosity/gather/cache_query.h"
#include "bake/radiosity/gather/cached_light.h"

namespace oriel {

// Calibrates the survival of paths at specular layers, by material, and sets it in `query`: the values that minimise
// variance times cost, from some rays of some texels (Bolin and Meyer 1997; Rath et al. 2022). A layer that reflects a
// bright window into a dim hall gets a path each time, the layer of a matte wall hardly ever. The values are powers of
// two, so that a small edit of the scene changes none. Error kStopped: nothing is set.
Status learn_survival(const Texels& texels, CacheQuery& query, std::span<const std::uint32_t> order,
                      const CachedLight& cached, const Stage& stage);

}  // namespace oriel
