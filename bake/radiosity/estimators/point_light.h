// The light at the points of finer cells: what the cached estimator does for texels, once, with the bounces that it
// has.
#pragma once

#include "bake/radiosity/estimators/estimator.h"
#include "bake/radiosity/estimators/filter.h"
#include "bake/radiosity/estimators/points.h"
#include "bake/radiosity/gather/cached_light.h"

namespace oriel {

// By point, as numbered in `texels`.
struct PointLight {
  Texels texels;               // points that lie inside something have visible 0
  std::vector<Vec3> light;     // lux
  std::vector<Vec3> variance;  // of it, stated, lux²
  std::vector<float> uneven;   // squared error of direct light that varies within the point's area, luminance
  GroupedLight grouped;        // light by group of lamps, if asked
  // Of points that gather: what their reflected light differs by from the texels' around, and the squared error of
  // that, both of luminance. 0 of others, which have the texels'.
  std::vector<float> reflected_change, reflected_noise;
};

// gathers: by page and place, the cells whose points gather light. Error kStopped.
Result<PointLight> light_points(const RadiosityTask& task, const TexelLight& known, const DetailPoints& points,
                                std::span<const std::vector<char>> gathers);

}  // namespace oriel
