// The baked lightmap as light that surfaces send out: what radiance maps see.
#pragma once

#include <span>

#include "bake/atlas/texel_map.h"
#include "bake/radiance/capture.h"
#include "bake/trace/path.h"
#include "formats/assets/lightmap.h"
#include "formats/assets/sharp_light.h"

namespace oriel {

// Irradiance at a point, lux: bilinear between texel centres, as the player's hardware does, and with a directional
// lightmap that of the normal `tilted` instead of `normal` (both unit, front side). 0 for triangles without a chart.
// Sharp light is that of texels.
Vec3 baked_irradiance(const Atlas& atlas, std::span<const LightmapPage> pages, const TexelPoint& at, const Vec3& tilted,
                      const Vec3& normal);

// What is lit and shows: `lights`, `atlas` and `pages` are those of the accelerator's scene.
struct BakedScene {
  const Accel& accel;
  const LightSet& lights;
  const Atlas& atlas;
  std::span<const LightmapPage> pages;
  float unlit_white = 1;              // what white unlit surfaces show, cd/m²
  const SharpLight* sharp = nullptr;  // of the pages; null: they have none

  // As baked_irradiance(), with sharp light at the point. factors: of it, by light group; empty: it shines once.
  Vec3 irradiance(const TexelPoint& at, const Vec3& tilted, const Vec3& normal) const;
  Vec3 sharp_irradiance_at(const TexelPoint& at, const Vec3& tilted, std::span<const Vec3> factors = {}) const;
};

// Radiance that a surface sends towards the eye, cd/m², by the player's shading equation: (1 - max R) kd/π E, the
// specular part as a wide lobe R E/π unless it is a mirror whose reflection is followed, and its own emission where
// that counts; backs reflect nothing. Constant cost: no further ray.
Vec3 baked_radiance(const BakedScene& baked, const SeenSurface& seen);

// The same, but glossy reflectors, and other surfaces that reflect more by their lobe than diffusely, show what that
// lobe does: its light is traced until it meets diffuse surfaces, the mean of so many paths where all of it counts
// (SeenSurface::throughput times reflectance), of fewer where less, or from mirrors, or where others are averaged with
// it, and as a wide lobe where less than 1 % counts. So a mirror shows the highlights in a polished floor and the shine
// of a dark window frame. Adds to `rays`.
inline constexpr std::uint32_t kLobePaths = 64;
Vec3 baked_radiance_with_lobes(const BakedScene& baked, const SeenSurface& seen, std::uint32_t paths,
                               std::uint64_t seed, std::uint64_t& rays);

// The same of kLobePaths, with the lobes of these triangles traced, too. Both must outlive it.
OutgoingRadiance with_lobes_of(const std::vector<bool>& triangles, const BakedScene& baked, std::uint64_t seed);

}  // namespace oriel
