// Mip levels of textures with cut-outs. Averaging all texels would mix in what is cut away, which may have any colour,
// and thin leaves would vanish as their alpha falls below the cutoff.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/assets/material.h"

namespace oriel {

// All levels from level 0, which is the texture's, to 1 x 1, of sizes max(1, size >> level); RGBA as the texture's.
// A texel's colour is the mean, of linear light, over the part of it that has alpha >= cutoff (cutoff > 0), or else
// (cutoff <= 0) weighted by alpha; where there is none of either, the colour of the next coarser level that has some.
// With a cutoff alpha is scaled so that in each level about as large a share of texels passes as in level 0, as far as
// texels of one alpha, which pass together, allow (Castano 2010, "Computing alpha mipmaps").
std::vector<std::vector<std::uint8_t>> cutout_mips(const Texture& texture, float cutoff);

}  // namespace oriel
