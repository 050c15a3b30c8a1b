// How often gather rays go on from the specular layers of what they meet.
#pragma once

#include "bake/radiosity/gather/cached_light.h"
#include "bake/radiosity/gather/surroundings.h"

namespace oriel {

// Tells it to `around`, by material of the scene: what makes noise times cost least, as some rays from some
// of the texels tell (Bolin and Meyer 1997; Rath et al. 2022). Layers that reflect a bright window into a dim hall are
// worth a path each time, those of a matte wall hardly any. Powers of two: a small edit of the scene changes none.
// Error kStopped, and nothing is told.
Status learn_survival(const Texels& texels, Surroundings& around, std::span<const std::uint32_t> order,
                      const CachedLight& cached, const Stage& stage);

}  // namespace oriel
