// The baked light as movers meet it: probes on an adaptive grid, and the bright lights that the probes leave out.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "formats/core/vec.h"

namespace oriel {

// The least difference of the cosines of a spot's inner and outer angle: as fine as floats have them near 1. Cones of a
// hundredth of a radian differ by 1e-4.
inline constexpr float kSharpestCone = 1e-6f;

inline constexpr std::size_t kMaxBrightLights = 64;  // of a field: sets of them are bits of 64
inline constexpr int kMaxFieldLevels = 2;            // of refinement
inline constexpr std::uint32_t kMaxDepthSide = 64;

enum class BrightLightKind : std::uint8_t { kPolygon, kPoint, kSpot, kDirectional };

// A light that shines and casts shadows on its own.
struct BrightLight {
  std::string name;
  BrightLightKind kind = BrightLightKind::kPoint;
  Vec3 intensity{0};          // polygon: radiance, cd/m²; point, spot: cd; directional: lux on a plane that faces it
  std::vector<Vec3> corners;  // polygon: triangles, three each, counter-clockwise seen from the front; pack space
  bool two_sided = false;     // polygon: shines from both sides
  Vec3 position{0};           // point, spot; pack space
  Vec3 direction{0, 0, -1};   // spot, directional: unit, the way the light travels
  float inner_cone_rad = 0, outer_cone_rad = 0;  // spot: half angles
  float angular_radius_rad = 0;                  // directional
};

// Incident light at one point.
struct LightProbe {
  Vec3 position{0};  // pack space
  // Most of what it sees are fronts of surfaces. Others lie inside walls: their light is that of the nearest valid one.
  bool valid = false;
  // Bits by LightField::lights. bright: the strongest here, which `sh` leaves out. kept: those that `sh` holds. In
  // neither: lights that do not reach this point.
  std::uint64_t bright = 0, kept = 0;
  std::vector<float> sh;  // R, G, B, bands² coefficients each: radiance, cd/m² (formats/core/sh.h)
  // Distance to the nearest surface by direction on an octahedral map (formats/core/octahedral.h), row by row from v =
  // 0: mean and mean square over a texel, as shares of depth_cap_m and its square.
  std::vector<Vec2> depth;
};

// A cell of the grid or a part of one.
struct FieldCell {
  std::array<std::uint32_t, 8> probes{};  // at its corners: bit 0 of the index is +x, bit 1 +y, bit 2 +z
  std::uint32_t children = 0;             // the first of eight parts, in the order of corners; 0: none
};

struct LightField {
  int bands = 0;  // 2 to 6; 0: there is no field
  std::uint32_t depth_side = 0;
  float depth_cap_m = 0;                // distances are cut there
  Vec3 lower{0}, cell_m{1};             // corner of the grid and size of its cells, pack space, metres
  std::array<std::uint32_t, 3> size{};  // cells along x, y, z
  std::vector<FieldCell> cells;         // the grid's, x fastest, then parts
  std::vector<LightProbe> probes;
  std::vector<BrightLight> lights;
  float error = 0;  // standard error of the coefficients, relative, root mean square over the valid probes
};

}  // namespace oriel
