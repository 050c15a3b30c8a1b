// KHR_lights_punctual: point, spot and directional lights, with measured profiles and the sun's size.
#pragma once

#include "bake/scene/scene.h"

namespace oriel {

// Luminous intensity of a point or spot light towards a unit direction that leaves it, cd per channel: colour ·
// intensity · spot cone, or colour · profile. 0 for directional lights.
Vec3 punctual_intensity(const Scene& scene, const Light& light, const Vec3& direction);

// All that a point or spot light sends out, lm; 0 for directional lights.
DVec3 punctual_power(const Scene& scene, const Light& light);

// Candela of a profile towards vertical and horizontal angles (any), degrees: bilinear between measured angles.
float profile_candela(const LightProfile& profile, float vertical_deg, float horizontal_deg);

// ∫ of that interpolation over all directions, lm.
double profile_flux(const LightProfile& profile);

// A uniform direction within `radius` (at most π/2) of `axis` (unit).
Vec3 sample_cone(const Vec3& axis, float radius_rad, const Vec2& v);

}  // namespace oriel
