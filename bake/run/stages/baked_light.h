// The baked lightmap as light that surfaces send out: what radiance maps see.
#pragma once

#include <span>

#include "bake/atlas/atlas.h"
#include "bake/radiance/sight.h"
#include "bake/trace/path.h"
#include "formats/assets/lightmap.h"

namespace oriel {

// Irradiance at a point of a triangle, lux: bilinear between texel centres, as the player's hardware does, and with a
// directional lightmap that of the normal `tilted` instead of `normal` (both unit, front side). 0 for triangles without
// a chart.
Vec3 baked_irradiance(const Atlas& atlas, std::span<const LightmapPage> pages, std::uint32_t triangle,
                      const Vec2& barycentric, const Vec3& tilted, const Vec3& normal);

// Radiance that a surface sends towards the eye, cd/m², by the player's shading equation: (1 - max R) kd/π E, the
// specular part as a wide lobe R E/π unless it is a mirror whose reflection is followed, and its own emission where
// that counts; backs reflect nothing. Constant cost: no further ray.
Vec3 baked_radiance(const Scene& scene, const Atlas& atlas, std::span<const LightmapPage> pages,
                    const SeenSurface& seen);

}  // namespace oriel
