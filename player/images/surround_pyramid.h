// A surround map prepared for shaders/lib/octahedral.glsl and surround.glsl.
#pragma once

#include <vector>

#include "formats/assets/surround_map.h"
#include "player/images/texture_data.h"

namespace oriel {

// Level l is the mean of 2^l x 2^l texels, down to one texel. Each has a border of one texel, in which the map goes on
// over its edges, so that the hardware's filter is right everywhere. Level 0 lies in the lower left corner of the
// image, the others above each other to its right.
struct SurroundPyramid {
  int size = 1;                      // of level 0, without borders
  IVec2 extent{1};                   // of the image, texels
  float scale = 1;                   // of light: a power of two that keeps it within RGB9E5
  std::vector<std::uint32_t> light;  // RGB9E5, extent.x * extent.y
  // 1/m, 0: sky; level 0 with its border, (size + 2)².
  std::vector<float> inverse_distance;
  // Inverse distance of the nearest and of the farthest surface; the latter is 0 where the sky is seen.
  Vec2 range{0};
};

IVec2 pyramid_corner(int size, int level);
// Texels that saw nothing usable take the light of coarser levels.
SurroundPyramid make_surround_pyramid(const SurroundMap& map);

struct SurroundTextures {
  gpu::Texture2d light, inverse_distance;
  int size = 1;
  float scale = 1;
  Vec2 range{0};
};
struct SurroundData {
  TextureData light, inverse_distance;
  SurroundTextures place;  // without its textures
};
SurroundData surround_data(const SurroundMap& map);
// On the device.
std::size_t surround_bytes(std::uint32_t size);

}  // namespace oriel
