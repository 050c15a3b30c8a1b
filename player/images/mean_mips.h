// Mip levels of textures that are shown whole.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/assets/material.h"

namespace oriel {

enum class Encoding { kSrgb, kLinear };

// All levels from level 0, which is the texture's, to 1 x 1, of sizes max(1, size >> level); RGBA as the texture's:
// means over what a texel covers, of linear light where colours are sRGB-encoded. Alpha is linear.
std::vector<std::vector<std::uint8_t>> mean_mips(const Texture& texture, Encoding encoding);

}  // namespace oriel
