// Marching a reflected ray through the distances around a point: the same maths as shaders/lib/surround.glsl.
//
// Seen from the centre, the points of a ray lie on a great circle, from the direction of its origin to its own. The ray
// is followed in even steps of the angle β to its direction, which are nearly even steps of texels; at β it is h / sin
// β from the centre, h being its least distance. Before the nearest and after the farthest surface it meets nothing.
// (After the light field probes of McGuire et al. 2017, which follow straight pieces of the octahedral map.)
#pragma once

#include "player/images/surround_pyramid.h"

namespace oriel {

inline constexpr int kSurroundSteps = 24;
inline constexpr int kSurroundHalvings = 4;  // of the step in which the ray passes behind the surface
// Things are taken for half as thick as they are far away: a ray that passes behind one by less hits a side of it that
// the map does not see, and shows its rim; one that passes farther behind is hidden by it.
inline constexpr float kSurroundThickness = 0.5f;
// Radians times texels by which a hidden ray steps back to see past what hides it: two texels, which filters mix.
inline constexpr float kSurroundBeside = 4;

struct SurroundHit {
  Vec3 direction{0, 0, 1};     // unit, from the centre to what is hit
  float inverse_distance = 0;  // 1/m along the ray; 0: sky
};

// The ray from `origin` (relative to the map's centre) along `direction` (unit). One that is hidden to its
// end takes what is seen beside the thing that hides it: the ground behind it. Where it meets nothing at all, it takes
// what lies in its direction from the centre.
SurroundHit march_surroundings(const SurroundPyramid& map, const Vec3& origin, const Vec3& direction);

}  // namespace oriel
