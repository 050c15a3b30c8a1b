// Sharp light at a point: what the player computes by pixel (shaders/lib/sharp_light.glsl), at a pixel without width.
#pragma once

#include <span>

#include "formats/assets/lightmap.h"
#include "formats/assets/sharp_light.h"

namespace oriel {

// lux at a place of a page (uv in [0,1]) that sharp light brings there. Both are as validate() wants them. p: pack
// space; normal: unit; factors: by light group, how many times lamps shine (empty: once).
Vec3 sharp_irradiance(const SharpLight& light, const LightmapPage& page, const Vec2& uv, const Vec3& p,
                      const Vec3& normal, std::span<const Vec3> factors = {});

}  // namespace oriel
