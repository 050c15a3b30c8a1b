// The maps of a reflector element on the GPU, as shaders/lib/march.glsl reads them: a layer each.
#pragma once

#include <span>
#include <vector>

#include "player/gpu/texture.h"
#include "player/maps/relief.h"

namespace oriel {

struct MapArray {
  // Disparity stays in 32 bits: half floats are decoded in software on CPUs, and a quarter of the memory is light.
  gpu::TextureArray light, disparity, ranges;
  std::vector<float> scale;  // of each layer's light

  // Layer i is maps[indices[i]]; smaller ones lie in the lower left corner.
  static MapArray upload(std::span<const RadianceMap> maps, std::span<const std::uint32_t> indices);
  std::size_t bytes() const { return light.bytes() + disparity.bytes() + ranges.bytes(); }
};

}  // namespace oriel
