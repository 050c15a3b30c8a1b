// The sky as a function of direction.
#pragma once

#include "bake/scene/scene.h"
#include "formats/assets/sky_map.h"

namespace oriel {

// Image coordinates in [0,1]², v downwards, of a direction (not zero).
Vec2 sky_uv(const SkyImage& image, const Vec3& direction);

// Radiance that arrives against `direction` from where the scene ends, cd/m²: the constant, or the image, bilinear
// between texel centres.
Vec3 sky_radiance(const Scene& scene, const Vec3& direction);

// By part of the sky, what share of its luminance towards `direction` is the part's; even shares where there is none.
void shares_of_sky(const Scene& scene, const Vec3& direction, std::vector<float>& shares);

// LightSample::group of the sky's light where it has parts.
inline constexpr std::uint32_t kSkyParts = ~0u - 1;

// Tells whose `light` is: add(group, light). What came against `direction` from a sky with parts (group kSkyParts) is
// shared as their luminance is there.
template <class Add>
void each_owner(const Scene& scene, std::uint32_t group, const Vec3& direction, const Vec3& light, const Add& add) {
  if (group != kSkyParts) return add(group, light);
  thread_local std::vector<float> shares;
  shares_of_sky(scene, direction, shares);
  for (std::size_t k = 0; k < shares.size(); ++k) add(scene.sky_parts.groups[k], shares[k] * light);
}

// Whose the light of the sky is, for each_owner().
inline std::uint32_t sky_owner(const Scene& scene) {
  return scene.sky_parts.empty() ? scene.sky_group : kSkyParts;
}

// Mean over the sphere of what sky_radiance interpolates, cd/m².
Vec3 sky_mean(const SkyImage& image);

// The image for a pack; none where it is of several hours, each with another.
SkyMap make_sky_map(const Scene& scene);

// The rows of the grid that has the texel centres as its corners: row k lies between v = (k - ½)/height and (k + ½)
// /height, cut at the poles. k from 0 to height. Upper and lower corner row, and the cosines of the polar angles.
struct SkyRow {
  std::uint32_t upper, lower;
  double cos_upper, cos_lower;
};
SkyRow sky_row(const SkyImage& image, std::uint32_t k);

}  // namespace oriel
