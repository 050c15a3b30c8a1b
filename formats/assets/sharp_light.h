// Direct light of points, spots and suns on flat surfaces, which is computed by pixel: the lamps, and by texel of the
// lightmap which triangles may stand between it and each of them. So shadows have their edges at any distance, however
// large the texels are (docs/notes/sharp-light.md).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formats/core/vec.h"

namespace oriel {

struct SharpLamp {
  bool sun = false;
  Vec3 position{0};                 // but of a sun; pack space
  Vec3 direction{0, 0, -1};         // spot, sun: unit, the way the light travels; of a profile angle 0
  Vec3 intensity{0};                // cd on the axis; sun: lux on a plane that faces it; times a profile's candela
  float cos_outer = -2;             // of a spot's half angle; a point's is below all cosines
  float inverse_falloff = 1;        // > 0: intensity times t², t = clamp((cosine - cos_outer) * inverse_falloff, 0, 1)
  float angular_radius_rad = 0;     // sun
  std::uint32_t light_group = ~0u;  // into Pack::light_groups, whose factors it follows; ~0u: none
  std::int32_t profile = -1;        // into SharpLight::profiles: no sun and no cone
  Vec3 right{1, 0, 0}, over{0, 1, 0};  // of a profile: unit, horizontal 0° and 90°
};

// Candela by direction, bilinear between even steps.
struct LampProfile {
  float first_deg = 0, last_deg = 180;  // vertical; beyond there is no light
  std::uint32_t rows = 2, columns = 1;  // from the first vertical angle to the last; all around, from 0° on
  std::vector<float> candela;           // row by row
};

// A page's LightmapPage::sharp_at holds, by texel, where in `words` its record begins; 0: there is none, and all light
// is the lightmap's. At that place:
//   kSharpSplit, then four places of the records of the texel's quarters: (x, y), (x + ½, y), (x, y + ½), (x + ½, y +
//   ½); or the number of lamps that reach it, and for each of them
//     SharpShine::code(),
//     where it is tinted a word in RGB9E5 (formats/core/half.h): what arrives of its light, such as through glass,
//     and a word for each triangle that may stand in the way: its number in `triangles` in the low 29 bits, and from
//     bit 29 on whether edge k, from corner k to k + 1, is one of the shadow's.
// Lamps that do not reach a texel are not listed. `words` is one record after the other; the first, at 0, is of no
// lamps, and the quarters of a split are records before it.
inline constexpr std::uint32_t kSharpSplit = ~0u;
inline constexpr int kMostSharpSplits = 5;  // of a texel into quarters of quarters
inline constexpr std::uint32_t kMostSharpLamps = 1024;
inline constexpr std::uint32_t kMostProfileSteps = 720;  // of a LampProfile, either way: half a degree all around
// Of a record: lamps, and triangles of each. A frame of one chart takes 40 ms more for a lamp
// (docs/notes/sharp-light.md).
inline constexpr std::uint32_t kMostShines = 16, kMostListed = 64;
// So that textures of 16384 rows hold them, which OpenGL 4.1 promises.
inline constexpr std::size_t kMostSharpWords = 1u << 25, kMostSharpTriangles = 1u << 24;
inline constexpr int kSharpEdgeShift = 29;

struct SharpShine {
  std::uint32_t lamp = 0;   // into SharpLight::lamps: 10 bits
  bool tinted = false;      // 1 bit
  std::uint32_t count = 0;  // of triangles: 21 bits

  std::uint32_t code() const { return count << 11u | (tinted ? 1u << 10u : 0u) | lamp; }
  static SharpShine of(std::uint32_t code) { return {code & 0x3ffu, (code >> 10u & 1u) != 0, code >> 11u}; }
};

struct SharpLight {
  std::vector<SharpLamp> lamps;  // none: all light is the lightmap's
  std::vector<std::uint32_t> words;
  std::vector<std::array<Vec3, 3>> triangles;  // pack space
  std::vector<LampProfile> profiles;

  bool empty() const { return lamps.empty(); }
};

}  // namespace oriel
