// Marching a reflected ray through a radiance map: the same maths as shaders/lib/march.glsl.
//
// The ray leaves the plane at s = 1 and goes to infinity at s = 0. Seen from the map's eye it runs over a straight line
// of pixels, and its disparity falls evenly along it: the map is a height field that the ray falls onto (as in relief
// mapping, Policarpo et al. 2005), and the ray's pixels are as many as the eye and the map's viewpoint differ by.
// Ranges of disparity over squares of 2^level pixels let it skip what it cannot meet.
#pragma once

#include <algorithm>

#include "player/images/relief.h"

namespace oriel {

// Of the surface around a texel, disparities differ from its own by no more than this share.
inline constexpr float kNear = 0.1f;
// Neighbouring pixels lie on one surface where their planes differ by no more than kGap, or meet and their disparities
// differ by no more than kSteep: in pixels by which things shift, seen from as far away as the element is wide, as
// bake/radiance/surface_grid.h cuts them. Elsewhere a ray does not hit the gap between them, it passes behind the
// nearer one.
inline constexpr float kGap = 0.5f, kSteep = 4;
// Unless it was no farther behind the nearer one than this share before the gap.
inline constexpr float kTouching = 0.003f;
// A ray hidden over 1 / kDistrust of the map is half trusted.
inline constexpr float kDistrust = 128;
// A ray within so many pixels of the border of a texel has left it.
inline constexpr float kBorder = 1e-3f;
// Between texels, disparity that differs by more than this share from the hit texel's own is another surface's too.
inline constexpr float kMixed = 0.03f;
inline constexpr int kMaxMarchSteps = 96;

// The part of a ray inside a map's frame: from a pixel position over `length` pixels (the longer of x and y) along
// `direction`, while the disparity falls from s_begin to s_end by `fall` a pixel. length < 0: none of it. hidden:
// pixels that it runs outside before.
struct MapRay {
  Vec2 from{0}, direction{0};
  float length = -1, s_begin = 1, s_end = 0, fall = 0, hidden = 0;

  float disparity(float at) const { return s_end + (length - at) * fall; }
};

// The ray from a point of the plane along `direction`, direction.z > 0, for a map with that eye (z < 0), element and
// size in pixels. Reflector space.
MapRay map_ray(const Vec3& eye, const Vec2& lower, const Vec2& upper, const IVec2& size, const Vec2& on_plane,
               const Vec3& direction);

// Where the ray meets a surface: pixel position, disparity, and trust in (0, 1], which falls with the pixels that the
// ray was hidden from the map before. trust 0: the map does not see it.
struct MapHit {
  Vec2 at{0};
  float s = 0, trust = 0;
};
MapHit march(const Relief& relief, const MapRay& ray);

// 1 / distance along the ray from the mirrored eye to a hit; 0 at infinity. to_plane: distance to where the ray leaves
// the plane; pace: length of `direction`, whose z is `rise`.
inline float inverse_distance(float s, float map_eye_z, float to_plane, float pace, float rise) {
  return s * rise / (s * rise * to_plane - map_eye_z * (1 - s) * pace);
}

}  // namespace oriel
