// The surface under the pointer and what the pack says of it. No OpenGL.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "formats/analysis/why.h"
#include "player/navigation/drag.h"

namespace oriel {

struct PickedSurface {
  std::string part, material;
  Vec3 at{0};            // pack space
  float distance_m = 0;  // along the ray
  Vec3 albedo{0};        // base colour there, [0,1], without what metals take from it
  float roughness = 0, metallic = 0;
  // Its nearest texel; page -1: none was baked for it, and what follows says nothing.
  std::int32_t page = -1;
  bool known = false;  // else the page is not there yet, and what follows says nothing
  IVec2 texel{0};
  TexelState state = TexelState::kEmpty;
  float lux = 0, lux_error = 0;  // illuminance, and one standard deviation of the bake's noise in it
  std::optional<Why> why{};      // once the pointer rests there
};

// A page of the lightmap; null: not there.
using PageOf = std::function<const LightmapPage*(std::uint32_t page)>;

// The first triangle of what stands still that the ray meets, from either side. Where texels of its texture are not
// there its albedo is that without.
std::optional<PickedSurface> pick_surface(const Pack& pack, const PickRay& ray, const PageOf& page_of);
// All is in the pack.
inline std::optional<PickedSurface> pick_surface(const Pack& pack, const PickRay& ray) {
  return pick_surface(pack, ray, [&](std::uint32_t page) { return &pack.lightmaps[page]; });
}

}  // namespace oriel
