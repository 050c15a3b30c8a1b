// The maps of a reflector element on the GPU, as shaders/passes/map_mesh.frag reads them: a layer each.
#pragma once

#include <span>
#include <vector>

#include "player/images/map_levels.h"
#include "player/images/texture_data.h"

namespace oriel {

// Before it is uploaded.
struct MapArrayData {
  TextureData light, disparity;
  std::vector<float> scale;  // of each layer's light
  // Layer i is maps[i]; smaller ones lie in the lower left corner.
  static MapArrayData make(std::span<const RadianceMap* const> maps);
  // The same without disparities.
  static MapArrayData light_of(std::span<const RadianceMap* const> maps);
};
// On the device, of maps of these sizes.
std::size_t map_array_bytes(std::span<const IVec2> sizes);
std::size_t map_light_bytes(std::span<const IVec2> sizes);  // of their light alone

struct MapArray {
  gpu::TextureArray light, disparity;  // map_levels.h
  std::vector<float> scale;
  std::vector<IVec2> sizes;  // of the layers' maps, pixels
};

// A map of a 2^coarser'th of the pixels a side, rounded down: of each square of pixels one, so that light and disparity
// belong together.
RadianceMap coarser_map(const RadianceMap& map, int coarser);

}  // namespace oriel
