// What a bake knows of its texels, as colours: illuminance, noise, the texels themselves. No OpenGL.
#pragma once

#include <vector>

#include "formats/assets/lightmap.h"
#include "formats/image/heat.h"
#include "player/scene/frame_options.h"

namespace oriel {

HeatScale heat_scale(Show show);  // of kLux and kError

// A page's colours by texel, RGBA8 as shown. kLux: false colour; kError: standard error over illuminance; kTexels: a
// checker of the baked ones, blue where they were filled from neighbours, red inside other geometry, black where there
// is no surface. Of no other Show.
std::vector<std::uint8_t> survey_colors(const LightmapPage& page, Show show);

}  // namespace oriel
