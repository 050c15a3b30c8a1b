// Sharp light at a point: what the player computes by pixel (shaders/lib/sharp_light.glsl), at a pixel without width.
#pragma once

#include <array>
#include <span>

#include "formats/assets/lightmap.h"
#include "formats/assets/sharp_light.h"

namespace oriel {

// Places of a disk of radius 1, each of an equal share of it.
extern const std::array<Vec2, 64> kSunPlaces;

// A place of a page, uv in [0,1], and the surface there: pack space; normal: unit.
struct SharpPlace {
  Vec2 uv{0};
  Vec3 position{0}, normal{0, 1, 0};
};

// Along a unit direction that leaves the lamp.
float candela_of(const LampProfile& profile, const SharpLamp& lamp, const Vec3& direction);

// lux that sharp light brings to a place of a page. Both are as validate() wants them. factors: by light group, how
// many times lamps shine (empty: once).
Vec3 sharp_irradiance(const SharpLight& light, const LightmapPage& page, const SharpPlace& at,
                      std::span<const Vec3> factors = {});

}  // namespace oriel
