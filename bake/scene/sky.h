// The sky as a function of direction.
#pragma once

#include "bake/scene/scene.h"

namespace oriel {

// Image coordinates in [0,1]², v downwards, of a direction (not zero).
Vec2 sky_uv(const SkyImage& image, const Vec3& direction);

// Radiance that arrives against `direction` from where the scene ends, cd/m²: the constant, or the image, bilinear
// between texel centres.
Vec3 sky_radiance(const Scene& scene, const Vec3& direction);

// Mean over the sphere of what sky_radiance interpolates, cd/m².
Vec3 sky_mean(const SkyImage& image);

// The rows of the grid that has the texel centres as its corners: row k lies between v = (k - ½)/height and (k + ½)
// /height, cut at the poles. k from 0 to height. Upper and lower corner row, and the cosines of the polar angles.
struct SkyRow {
  std::uint32_t upper, lower;
  double cos_upper, cos_lower;
};
SkyRow sky_row(const SkyImage& image, std::uint32_t k);

}  // namespace oriel
