// Which surface a texel of a lightmap shows.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/pack/pack.h"

namespace oriel {

// Of the surface under a texel's centre; pack space.
struct TexelPlace {
  static constexpr std::uint32_t kNowhere = ~0u;
  std::uint32_t part = kNowhere;  // into Mesh::parts; kNowhere: the centre is beside all charts
  float side_m = 0;               // root of the texel's area
  Vec3 position{0};               // metres
  Vec3 normal{0};                 // unit, of the triangle
};

// By page and texel. pack: one that validate() finds no error in.
std::vector<std::vector<TexelPlace>> texel_places(const Pack& pack);

}  // namespace oriel
