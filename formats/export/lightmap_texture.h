// Lightmap pages as textures for engines.
#pragma once

#include <optional>

#include "formats/assets/lightmap.h"
#include "formats/export/ktx2.h"

namespace oriel {

// What one unit of a page's texture means, lux: 1, or the power of two that brings the page within kRgb9e5Max.
float texture_scale(const LightmapPage& page);

struct LightmapTexture {
  Ktx2Texture texture;  // irradiance over texture_scale()
  double rounding = 0;  // what the coding changes: root mean square over channels of lit texels, of the texel's largest
};

// kRgb9e5: a channel is off by at most 2^-9 of its texel's largest. kBc6h takes a quarter of its bytes and rounds as
// much as blocks of 4 x 4 texels need. Without a coding: BC6H where it rounds by at most a quarter of the page's own
// standard error (root mean square, of the texel's light): beside that it adds 3 % of it; RGB9E5 elsewhere.
LightmapTexture lightmap_texture(const LightmapPage& page, std::optional<TexelCoding> coding);

}  // namespace oriel
