// Radiosity textures: irradiance per texel, with its error.
#pragma once

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
};

}  // namespace oriel
