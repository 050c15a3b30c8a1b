// Radiosity textures: irradiance per texel, with its error.
#pragma once

#include <algorithm>
#include <vector>

#include "formats/core/vec.h"

namespace oriel {

enum class TexelState : std::uint8_t {
  kEmpty = 0,     // no surface, and too far from any to matter
  kDilated = 85,  // filled from neighbours so that bilinear filtering near a chart's border reads light, not black
  kBuried = 170,  // a surface is here, but inside other geometry: filled from neighbours
  kValid = 255,   // baked
};

// Texel (x, y) is at y * width + x; its centre at uv ((x + ½) / width, (y + ½) / height). Row 0 is v = 0.
struct LightmapPage {
  std::uint32_t width = 0, height = 0;
  std::vector<Vec3> irradiance;  // lux, linear Rec. 709, finite and >= 0
  std::vector<Vec3>
      standard_error;  // lux per channel: one standard deviation of the estimate's own noise; 0 where not baked
  std::vector<TexelState> state;
  // Of a directional lightmap, else empty: the L1 band of the incident luminance over its L0 band, d = v / m with
  // m = ∫ L dω / 4π and v = ∫ L ω dω / 4π above the texel; pack space, |d| <= 1. Where the back of a double-sided
  // surface was baked it is negated: what front and back show is then one function of the front's normals.
  std::vector<Vec3> direction{};
};

// E(n) / E(g): how the irradiance at a texel changes when its normal g is tilted to n (both unit), by linear spherical
// harmonics: (1 + 2 d·n) / (1 + 2 d·g), written so that it is exactly 1 for n = g, and guarded (docs/conventions.md,
// "Directional lightmaps"). 0 up; at most 3 for normals and light above the surface.
inline float directional_ratio(const Vec3& d, const Vec3& n, const Vec3& g) {
  return std::max(1 + 2 * glm::dot(d, n - g) / std::max(1 + 2 * glm::dot(d, g), 1.0f), 0.0f);
}

}  // namespace oriel
