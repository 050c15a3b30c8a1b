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
  BookedLight booked;          // light by group of lamps, if asked
};

// Error kStopped.
Result<PointLight> light_points(const RadiosityTask& task, const TexelLight& known, const DetailPoints& points);

}  // namespace oriel
