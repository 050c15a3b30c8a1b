// A scene whose lightmap is laid out.
#pragma once

#include "bake/atlas/texel_map.h"
#include "bake/trace/path.h"

namespace oriel {

// All of it outlives who is given it.
struct LightmapScene {
  const Transport& transport;
  const Atlas& atlas;
  std::span<const TexelMapPage> map;
};

}  // namespace oriel
