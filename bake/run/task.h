// What the stages of one bake share.
#pragma once

#include <span>

#include "bake/run/baked_light.h"
#include "bake/run/options.h"
#include "bake/run/prepare.h"

namespace oriel {

// All of it outlives them.
struct BakeTask {
  const BakeOptions& options;
  const PreparedScene& prepared;
  const LightSet& lights;  // of the prepared scene
  Context& context;
  std::span<const LightmapPage> lightmaps;  // baked so far
  float unlit_white = 1;                    // cd/m², unlit.h
  const SharpLight* sharp = nullptr;        // of the lightmaps; null: they have none

  const Scene& scene() const { return prepared.scene(); }
  const Accel& accel() const { return *prepared.accel; }
  // With the light so far.
  BakedScene baked() const { return {accel(), lights, prepared.atlas, lightmaps, unlit_white, sharp}; }
};

}  // namespace oriel
