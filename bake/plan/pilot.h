// Small parts of a bake that its cost is told from.
#pragma once

#include "bake/plan/predict.h"
#include "bake/run/baked_light.h"
#include "formats/pack/pack.h"

namespace oriel {

// Mesh, materials and textures alone: whole with lightmaps for the atlas's pages.
Pack pack_of_scene(const Scene& scene, const Atlas& atlas);

// Radiance and surround maps. Views are planned with 1/16 and 1/4 of the samples: seconds grow with samples, pixels
// with their logarithm, as greedy choice adds maps. One map of each reflector is captured with 1/16 of its pixels, and
// its seconds and stored bytes a pixel count for all of the reflector's. `coarse`: a lightmap of a pilot. Error
// kStopped.
Result<Component> pilot_reflections(const CensusInput& in, const BakedScene& coarse, Context& context);

}  // namespace oriel
