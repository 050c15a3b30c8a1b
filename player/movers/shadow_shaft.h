// Shadows of a mover in the light of one point: the map, just as wide as the sphere around the mover, so that it holds
// all that its shadow can fall on, and the part of space where that is. No OpenGL.
#pragma once

#include <array>

#include "formats/core/vec.h"
#include "player/navigation/culling.h"

namespace oriel {

struct Shaft {
  Mat3 frame{1};      // across, up, along: pack space
  Vec3 from{0};       // the point; of a direction, the sphere's centre
  float tangent = 1;  // of half its width; of a direction: half its width, metres
  bool parallel = false;
  float distance = 0;  // from `from` to the sphere's centre
};

// at: LightSamples::at. sphere: centre and radius.
Shaft make_shaft(const Vec4& at, const Vec4& sphere);

// Distances along the shaft, nearest and farthest, that a map of the mover alone and one of the scene hold. reach: as
// far as the scene goes from anywhere within it.
Vec2 mover_range(const Shaft& shaft, float radius);
Vec2 scene_range(const Shaft& shaft, float reach);

Mat4 clip_from_pack(const Shaft& shaft, const Vec2& range);

// What shaders look a map up with: (x, y, along, w), x / w and y / w in [-1, 1] inside; `along` in metres, w = 1 where
// parallel and along otherwise. And (a, b) of the depth in a map of that range: a + b · along where parallel, a + b /
// along otherwise.
Mat4 place_from_pack(const Shaft& shaft);
Vec2 depth_terms(const Shaft& shaft, const Vec2& range);

// Where the shadow of a sphere can fall, in the light of all points: the cone that touches both.
struct ShadowCone {
  bool everywhere = false;     // light and sphere meet
  Vec3 center{0};              // of the sphere
  Mat3 frame{1};               // across, up, along
  float radius = 0;            // of the sphere, and a margin
  float width = 0, slope = 0;  // half width at a distance t along, from the centre: width + slope · t
};
// center, radius: LightSamples.
ShadowCone make_shadow_cone(const Vec4& sphere, const Vec3& center, float radius, bool parallel);

bool may_meet(const ShadowCone& cone, const Vec4& sphere);

// A tapered box that holds sphere and cone as far as `bounds` go: corners by bits x, y, z of a right-handed frame.
using ShadowBox = std::array<Vec3, 8>;
ShadowBox make_shadow_box(const ShadowCone& cone, const Bounds& bounds);

}  // namespace oriel
