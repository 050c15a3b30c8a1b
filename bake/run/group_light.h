// Groups of lamps as a pack holds them.
#pragma once

#include <functional>

#include "bake/radiosity/radiosity.h"
#include "bake/run/assemble.h"
#include "bake/run/baked_light.h"

namespace oriel {

// Fills the pack's light_groups and group_lights; no groups where the light was not told apart. All else of the pack is
// there. A material that shines in several groups becomes one for each. light: as Radiosity::groups. Few rays
// tell the shares of light once it is late(). Error kStopped.
Status assemble_light_groups(const BakedScene& baked, const std::vector<std::vector<LightmapPage>>& light,
                             const std::function<bool()>& late, const Stage& stage, Pack& pack);

}  // namespace oriel
