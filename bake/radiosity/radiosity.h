// The radiosity stage: irradiance of each lightmap texel, with its standard error.
#pragma once

#include "bake/radiosity/estimators/radiosity_options.h"
#include "bake/radiosity/texels/lightmap_scene.h"

namespace oriel {

// Whether direct light of points, spots and suns is found apart, by pixel (docs/notes/sharp-light.md).
inline bool finds_sharp_light(const RadiosityOptions& options) {
  return options.sharp && options.estimator == Estimator::kCached && options.hidden == Hidden::kLeftOut;
}

// Bakes the light of front sides; split_sides() gives lit backs texels of their own.
//
// options.estimator: `cached`, the default of oriel-bake (estimators/cached.h; docs/notes/radiosity.md describes its
// steps), or `reference`: unbiased paths from points spread over each texel, with light and BSDF sampling combined.
// Both leave out points inside other geometry (probes from there hit almost only back faces) and points behind a wall
// on the texel. A texel with no point left is kBuried and is filled from its chart's neighbours. Stage name
// "radiosity"; error kStopped.
Result<Radiosity> bake_radiosity(const LightmapScene& scene, const RadiosityOptions& options, Context& context);

}  // namespace oriel
