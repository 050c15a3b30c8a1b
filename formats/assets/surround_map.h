// What curved reflectors see: radiance with distance all around a point (light field probes, McGuire et al. 2017,
// "Real-Time Global Illumination using Precomputed Light Field Probes").
#pragma once

#include <string>
#include <vector>

#include "formats/core/vec.h"

namespace oriel {

// Texel (x, y) is at y * size + x: the direction (pack space) of the point ((x, y) + ½) / size * 2 - 1 of the
// octahedral map (formats/core/octahedral.h).
struct SurroundMap {
  Vec3 centre{0};                       // pack space
  std::uint32_t size = 0;               // a power of two
  std::vector<Vec3> radiance;           // cd/m², linear Rec. 709; the diffuse reflected light and emission
  std::vector<float> inverse_distance;  // 1/m, of what is seen from the centre; 0: sky
  // Whether the texel saw a surface (1), nothing but sky (2) or the back of a surface (0).
  std::vector<std::uint8_t> valid;
};

// A shiny surface that is not planar, or a piece of one.
struct CurvedReflector {
  std::string name;                    // of the part it was found in
  std::uint32_t material = 0;          // into Pack::materials
  std::uint32_t map = 0;               // into Pack::surround_maps; its own triangles are not seen there
  std::vector<std::uint32_t> indices;  // its triangles, into Mesh's vertices
};

}  // namespace oriel
