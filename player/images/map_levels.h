// What the device holds of a radiance map: its disparities, and its light at several sizes.
#pragma once

#include <vector>

#include "formats/assets/radiance_map.h"

namespace oriel {

// Row by row, as multiples of 1 / kDisparityCodes: off by no more than a 64th of a pixel of 1024, seen from as far away
// as the element is wide. Pixels that saw nothing usable have 2, nearer than all that is.
inline constexpr float kDisparityCodes = 32767;
std::vector<std::uint16_t> disparity_codes(const RadianceMap& map);

// Radiance over `scale`, a power of two that keeps it within RGB9E5, with averages over 2^i pixels at level i; sizes
// halve, rounded down, to 1. At each level what is unseen takes the mean of what is seen beside it, so that filtering
// brings in no black.
struct LightLevels {
  float scale = 1;
  std::vector<std::vector<std::uint32_t>> rgb9e5;
};
LightLevels make_light_levels(const RadianceMap& map);

}  // namespace oriel
