// Lamps that are switched together, and their light apart from all other.
#pragma once

#include <string>
#include <vector>

#include "formats/core/vec.h"

namespace oriel {

inline constexpr std::size_t kMaxLightGroups = 64;

// All light of a pack is that of its groups, each times its value and colour; baked are value 1 and colour (1, 1, 1).
struct LightGroup {
  std::string name;                // no two groups have the same
  std::vector<std::string> lamps;  // names
  float value = 1;                 // when the pack is opened
  Vec3 color{1};                   // likewise: factors, linear Rec. 709
  // Whose emission is the group's: indices of the pack's materials, of which none is of two groups, of its emitters and
  // of the bright lights of its light field.
  std::vector<std::uint32_t> materials, emitters, bright_lights;
  bool sky = false;  // the sky is the group's
  // By reflector and by surround map: the group's share of the light that it shows, 0 to 1 a channel.
  std::vector<Vec3> reflectors, surrounds;
};

// Light of one group on one lightmap page, where there is any: as that page's irradiance and detail, of the same sizes.
// Over all groups they sum to the page's but for rounding.
struct GroupLight {
  std::uint32_t group = 0, page = 0;
  std::uint32_t width = 0, height = 0;
  std::vector<Vec3> irradiance;  // lux
  std::uint32_t detail_width = 0, detail_height = 0;
  std::vector<Vec3> detail;  // lux
};

}  // namespace oriel
