// Radiosity textures: irradiance per texel, with its error.
#pragma once

#include <algorithm>
#include <cmath>
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
  // m = ∫ L dω / 4π and v = ∫ L ω dω / 4π above the texel; pack space, |d| <= 1.
  std::vector<Vec3> direction{};
};

// E(n) / E(g): how the irradiance at a texel changes when its normal g is tilted to n (both unit). d is read as an even
// hemisphere of light together with one distant lamp: the share of the lamp and its direction follow from d, and the
// irradiance of both is closed (docs/conventions.md, "Directional lightmaps"). Finite and not negative; 1 for n = g.
inline float directional_ratio(const Vec3& d, const Vec3& n, const Vec3& g) {
  const Vec3 off = d - 0.5f * g;  // d = (1 - lamp) g / 2 + lamp ω, |ω| = 1
  const float h = 0.5f - glm::dot(d, g);
  const float lamp = std::clamp((std::sqrt(h * h + 3 * length2(off)) - h) / 1.5f, 0.0f, 1.0f);
  const Vec3 towards = off + 0.5f * lamp * g;  // lamp ω
  const auto light_on = [&](const Vec3& normal) {
    const Vec3 mirrored =
        normal - 2 * glm::dot(normal, g) * g;  // what of the lobe is below the surface counts above it
    return 1 - lamp + 2 * (std::max(glm::dot(towards, normal), 0.0f) + std::max(glm::dot(towards, mirrored), 0.0f));
  };
  const float untilted = light_on(g);
  return std::max(1 + (light_on(n) - untilted) / std::max(untilted, 0.1f), 0.0f);
}

}  // namespace oriel
