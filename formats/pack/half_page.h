// A lightmap page as graphics devices take it: half floats.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formats/core/half.h"
#include "formats/core/vec.h"

namespace oriel {

using Half4 = std::array<std::uint16_t, 4>;  // a is 1

// What of a page there is in a file.
struct LightmapFlags {
  bool directional = false;
  bool sharp = false;  // places of sharp light, and what of it texels have
};

struct HalfPage {
  std::uint32_t width = 0, height = 0;
  float scale = 0;               // a power of two; 0: the page is black
  std::vector<Half4> light;      // irradiance / scale, without sharp light, finite and >= 0
  std::vector<Half4> direction;  // of a directional lightmap, as LightmapPage's, else empty
  // As LightmapPage's; detail / scale.
  std::vector<std::uint32_t> cell{};
  std::uint32_t detail_width = 0, detail_height = 0;
  std::vector<Half4> detail{};
  std::vector<std::uint32_t> sharp_at{};  // as LightmapPage's
};

inline constexpr std::uint16_t kHalfOne = 0x3c00;  // exact: 1 in binary16

inline Half4 halves_of(const Vec3& v, float scale = 1) {
  if (!is_finite(v)) return {0, 0, 0, kHalfOne};
  return {half_from_float(v.x * scale), half_from_float(v.y * scale), half_from_float(v.z * scale), kHalfOne};
}

inline std::vector<Half4> halves_of(const std::vector<Vec3>& directions) {
  std::vector<Half4> out;
  out.reserve(directions.size());
  for (const Vec3& d : directions) out.push_back(halves_of(d));
  return out;
}

}  // namespace oriel
