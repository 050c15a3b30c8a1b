// What curved reflectors see as cubes, for engines that light by probes.
#pragma once

#include "formats/assets/surround_map.h"
#include "formats/export/ktx2.h"

namespace oriel {

// The direction (not of length 1) of a point of a cube's face, +X -X +Y -Y +Z -Z; at in [0,1]², y down (OpenGL 4.6,
// section 8.13).
Vec3 cube_direction(std::uint32_t face, const Vec2& at);

// A cube of the map's radiance, half as wide as the map, so that its texels are somewhat finer: kBc6h or kRgb9e5, cd/m²
// over `scale`. Texels that saw backs of surfaces alone are filled from around them. Each is a mean over 2 x 2 places.
struct ProbeCube {
  Ktx2Texture texture;
  float scale = 1;      // a power of two
  double rounding = 0;  // root mean square over channels, of the texel's largest
};
ProbeCube probe_cube(const SurroundMap& map, TexelCoding coding);

}  // namespace oriel
