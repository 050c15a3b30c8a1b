// Radiosity textures: irradiance per texel of the lightmap, with its standard error.
#pragma once

#include "bake/radiosity/estimators/radiosity_options.h"
#include "bake/radiosity/texels/lightmap_scene.h"

namespace oriel {

// Texels hold the light of the front sides; split_sides() gives lit backs texels of their own.
//
// By options.estimator: `cached`, the default of oriel-bake (estimators/cached.h; docs/notes/radiosity.md tells its
// order), or `reference`: unbiased paths from points spread over each texel, light and BSDF sampling combined. Of both,
// points that lie inside other geometry (independent probes meet little but back faces of one-sided materials) are left
// out, and so are those behind a wall that stands on the texel; a texel with none left is kBuried and filled from its
// chart's neighbours. Stage name "radiosity"; error kStopped.
Result<Radiosity> bake_radiosity(const LightmapScene& scene, const RadiosityOptions& options, Context& context);

}  // namespace oriel
