// What a bake knows of its texels, as colours: illuminance, noise, the texels themselves. No OpenGL.
#pragma once

#include <vector>

#include "formats/assets/lightmap.h"
#include "player/scene/frame_options.h"

namespace oriel {

// Logarithmic scales: the colours of heat() from the lowest value to the highest.
struct HeatScale {
  float lowest = 1, highest = 1;
  const char* unit = "";
};
inline constexpr HeatScale kLuxScale{10, 10000, "lux"};
inline constexpr HeatScale kErrorScale{0.001f, 0.1f, "of the illuminance"};  // one standard deviation
HeatScale heat_scale(Show show);                                          // of kLux and kError

// Dark blue by green and yellow to white; share is clamped to [0, 1]. sRGB as shown, [0, 1].
Vec3 heat(float share);
// Where a value stands on a scale, [0, 1]; 0 for what is not positive.
float share_of(const HeatScale& scale, float value);

// A page's colours by texel, RGBA8 as shown. kLux: false colour; kError: standard error over illuminance; kTexels: a
// checker of the baked ones, blue where they were filled from neighbours, red inside other geometry, black where there
// is no surface.
std::vector<std::uint8_t> survey_colors(const LightmapPage& page, Show show);

}  // namespace oriel
