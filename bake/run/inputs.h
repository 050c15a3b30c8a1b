// What stages are functions of, as bytes to hash: what names their units of work (bake/jobs/units.h). Only what enters
// a result is among them: no names, no cameras, no place in the world.
#pragma once

#include "bake/atlas/atlas.h"
#include "bake/run/baked_light.h"
#include "formats/core/archive.h"

namespace oriel {

// Shapes, and how they reflect light and let it pass.
struct SurfacesOf {
  const Scene& scene;
};
void fields(Archive& archive, const SurfacesOf& of);

// What shines: emission, lights, sky.
struct LightsOf {
  const Scene& scene;
};
void fields(Archive& archive, const LightsOf& of);

// Where each triangle lies on the lightmap's pages.
struct LayoutOf {
  const Atlas& atlas;
};
void fields(Archive& archive, const LayoutOf& of);

// All that light which is already baked depends on.
struct LitScene {
  const BakedScene& baked;
};
void fields(Archive& archive, const LitScene& of);

}  // namespace oriel
