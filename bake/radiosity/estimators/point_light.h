// The light at the points of finer cells: the cached estimator's direct light and final gather, done once, with the
// texels' cache for the bounces.
#pragma once

#include "bake/radiosity/estimators/estimator.h"
#include "bake/radiosity/estimators/filter.h"
#include "bake/radiosity/estimators/points.h"
#include "bake/radiosity/gather/cached_light.h"

namespace oriel {

// Light by point; points are numbered as in `texels`.
struct PointLight {
  Texels texels;               // points inside a body have visible 0
  std::vector<Vec3> light;     // lux
  std::vector<Vec3> variance;  // estimated, lux²
  std::vector<float> uneven;   // variance of direct light within the point's area, luminance, lux²
  GroupedLight grouped;        // `light` by light group; may be empty
  // Per point that gathers: luminance difference of its reflected light from the interpolated texels, lux, and the
  // variance of that, lux². 0 for others, which take the texels' light.
  std::vector<float> reflected_change, reflected_noise;
};

// gathers: by page and place, true for cells whose points gather light. Error kStopped.
Result<PointLight> light_points(const RadiosityTask& task, const TexelLight& texel_light, const DetailPoints& points,
                                std::span<const std::vector<char>> gathers);

}  // namespace oriel
