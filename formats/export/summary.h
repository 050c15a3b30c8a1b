// Numbers about a pack that tables print.
#pragma once

#include <array>
#include <cstdint>

#include "formats/pack/pack.h"

namespace oriel {

// Of the texels whose state is kValid.
struct LightmapSummary {
  std::array<std::uint64_t, 4> states{};          // empty, dilated, buried, valid
  double min_lux = 0, mean_lux = 0, max_lux = 0;  // luminance-weighted; 0 where no texel is valid
  double error = 0;           // square root of the mean squared standard error, over the mean irradiance; 0 in the dark
  double mean_direction = 0;  // length of the directions; 0 where there are none
};
LightmapSummary summarise(const LightmapPage& page);

struct RadianceMapSummary {
  std::array<std::uint64_t, 3> pixels{};  // nothing usable, surface, sky
  double mean = 0, max = 0;               // cd/m², of the surface pixels
};
RadianceMapSummary summarise(const RadianceMap& map);
RadianceMapSummary summarise(const SurroundMap& map);

// Pack space, metres; zeros for a mesh without vertices.
struct MeshBounds {
  Vec3 lower{0}, upper{0};
};
MeshBounds bounds_of(const Mesh& mesh);

}  // namespace oriel
