// A bright light as a few points, for shadows: no OpenGL.
#pragma once

#include <span>

#include "formats/assets/light_field.h"

namespace oriel {

inline constexpr int kMaxLightPoints = 16;

// The same maths as shaders/lib/light_samples.glsl.
struct LightSamples {
  // Points of it (w = 1), or unit directions to it (w = 0). Each stands for one count-th of it.
  std::vector<Vec4> at;
  // Point, spot: cd. Directional: lux. Polygon: cd/m² times its area in m².
  Vec3 intensity{0};
  Vec3 axis{0, -1, 0};  // unit, the way that a spot or a polygon's front shines
  // cos of spots' cones: shine over [outer, inner]; polygons: shines as the cosine, (1, 0); two-sided ones (1, -1);
  // others (-2, -3): to all sides.
  Vec2 cones{-2, -3};
  bool cosine = false;  // a polygon: intensity falls with the cosine to its axis
  Vec3 center{0};       // of the points, or the direction to it where directional
  float radius = 0;     // that holds the points, metres; directional: tangent of its angular radius
};
// points: of lights that have a size, 1 to kMaxLightPoints. look: other points in each, even over all (FrameOptions).
LightSamples sample_light(const BrightLight& light, int points = kMaxLightPoints, std::uint32_t look = 0);

// How many points a light's shadows of those movers are taken from: by how large it looks from the nearest, and more
// where few movers are lit, as a light that is seen through a door needs them. spheres: around the movers. pairs: of
// any mover and a light that shines on it. most: 1 to kMaxLightPoints.
int choose_points(const BrightLight& light, std::span<const Vec4> spheres, std::size_t pairs, int most);

// Irradiance of a surface at p that faces sample i, unshadowed, times `count`: the sum over i is that of the light.
// towards: unit, from p to the sample.
Vec3 facing_irradiance(const LightSamples& light, std::size_t i, const Vec3& p, Vec3& towards);

}  // namespace oriel
