// How much of what radiance maps see is traced along lobes.
#pragma once

#include "bake/run/baked_light.h"

namespace oriel {

// The share of the pixels of planned maps that trace a lobe (traces_lobe), each for as often as it does, by every 8th
// of them along each axis. glossy: by triangle, those whose lobes are traced in any case; may be empty. Error kStopped.
Result<double> lobe_share(const BakedScene& baked, const ReflectedSurroundings& surroundings,
                          std::span<const RadianceMap> maps, const std::vector<bool>& glossy, Context& context);

}  // namespace oriel
