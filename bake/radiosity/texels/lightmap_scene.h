// A scene with its lightmap layout.
#pragma once

#include "bake/atlas/texel_map.h"
#include "bake/trace/path.h"

namespace oriel {

// The references must outlive all that uses this.
struct LightmapScene {
  const Transport& transport;
  const Atlas& atlas;
  std::span<const TexelMapPage> map;
};

}  // namespace oriel
