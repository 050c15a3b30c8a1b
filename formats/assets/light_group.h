// Lamps that are switched together, and their light apart from all other.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "formats/assets/mover_motion.h"
#include "formats/core/vec.h"

namespace oriel {

inline constexpr std::size_t kMaxLightGroups = 64;

// All light of a pack is that of its groups, each times its value and colour; baked are value 1 and colour (1, 1, 1).
struct LightGroup {
  std::string name;                // no two groups have the same
  std::vector<std::string> lamps;  // names
  float value = 1;                 // when the pack is opened
  Vec3 color{1};                   // likewise: factors, linear Rec. 709
  Vec3 own_color{1};               // of its lamps' light together, luminance 1: what a wanted colour is held against
  // Whose emission is the group's: indices of the pack's materials, of which none is of two groups, of its emitters and
  // of the bright lights of its light field.
  std::vector<std::uint32_t> materials, emitters, bright_lights;
  bool sky = false;  // the sky is the group's
  // Of the node that its lamps hang on, where the file animates it: as Mover's. The light was baked at rest.
  MoverPose rest;
  std::vector<MoverKey> keys;
  // By reflector and by surround map: the group's share of the light that it shows, 0 to 1 a channel.
  std::vector<Vec3> reflectors, surrounds;
  std::vector<Vec3> probes;  // likewise, by probe of the light field: of its harmonics
};

// Light of a texel or point, R, G, B: halves without their last four bits, a relative error of at most 2^-8.
using GroupCode = std::array<std::uint16_t, 3>;
inline constexpr int kGroupCodeShift = 4;
inline constexpr std::uint16_t kLargestGroupCode = 0x7bff >> kGroupCodeShift;

// The light of one group, where it is not `rest`.
struct GroupTexels {
  std::uint32_t group = 0;
  std::vector<GroupCode> light, detail;  // lux / 2^exponent; by texel and by point of the page's details
};

// What a lightmap page's light but for sharp light is made of. One group of each texel is not stored: its light is what
// the others leave of the page's, which therefore is the sum of all. It is the brightest, so that little of its
// accuracy is lost.
struct PageGroups {
  std::uint32_t page = 0;
  std::uint32_t width = 0, height = 0, detail_width = 0, detail_height = 0;  // the page's
  int exponent = 0;
  std::vector<std::uint8_t> rest, rest_of_detail;  // groups, by texel and by point
  std::vector<GroupTexels> others;                 // that have light somewhere; of no two the same group
};

}  // namespace oriel
