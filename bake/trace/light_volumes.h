// Which mirrors a light reaches by way of which: its volumes, cut by each mirror that it meets.
#pragma once

#include "bake/trace/virtual_lights.h"

namespace oriel {

struct FoundLights {
  std::vector<VirtualLight> lights;  // brightest first
  double left_out = 0;               // as VirtualLights::left_out()
};

// Best first, so that `most` keeps the brightest: what one more mirror passes on is never more than what came to it.
FoundLights find_virtual_lights(const Scene& scene, const PlanarMirrors& mirrors, int most_mirrors, std::size_t most,
                                double least);

}  // namespace oriel
