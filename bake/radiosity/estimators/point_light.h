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
  // The part of `light` that gather rays find, with its variance, and by light group.
  Estimate reflected;
  GroupedLight reflected_grouped;
};

// The light that points build on: bounces, and reflected light where they do not gather.
struct CoarserLight {
  const TexelLight& of_texels;
  const PointLight* first;                     // points of two steps; null: they are what is lit, and gather
  std::span<const std::vector<char>> gathers;  // by page and place, 1 for cells whose first points gather
};

// Reflected light bends less than direct light: first points gather where it bends within texels, and further points
// interpolate theirs. Error kStopped.
Result<PointLight> light_points(const RadiosityTask& task, const CoarserLight& coarser, const DetailPoints& points);

}  // namespace oriel
