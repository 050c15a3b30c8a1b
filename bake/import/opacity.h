// Which surfaces hide all that is behind them, whatever alpha mode the file says.
#pragma once

#include "bake/scene/scene.h"

namespace oriel {

// Surfaces of BLEND whose alpha is 1 at each of their points, and of MASK whose alpha reaches the cutoff there, become
// OPAQUE: some exporters write one mode for all materials. Alpha is that of the factor, the vertex colours and the
// texels that the surface uses; what rounds to 255 of 255 is 1. A material that other surfaces use with less alpha is
// copied. The images must be there.
void find_opaque(Scene& scene);

}  // namespace oriel
