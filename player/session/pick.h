// The surface under the pointer and what the pack says of it. No OpenGL.
#pragma once

#include <optional>
#include <string>

#include "player/poses/drag.h"

namespace oriel {

struct PickedSurface {
  std::string part, material;
  Vec3 at{0};            // pack space
  float distance_m = 0;  // along the ray
  Vec3 albedo{0};        // base colour there, [0,1], without what metals take from it
  float roughness = 0, metallic = 0;
  // Its nearest texel; page -1: none was baked for it, and what follows says nothing.
  std::int32_t page = -1;
  IVec2 texel{0};
  TexelState state = TexelState::kEmpty;
  float lux = 0, lux_error = 0;  // illuminance, and one standard deviation of the bake's noise in it
};

// The first triangle of what stands still that the ray meets, from either side.
std::optional<PickedSurface> pick_surface(const Pack& pack, const PickRay& ray);

}  // namespace oriel
