// Shadow maps of a mover: from a point of a light, just as wide as the sphere around the mover, so that the map holds
// all that its shadow can fall on. No OpenGL; the same maths as shaders/lib/shadow_shaft.glsl.
#pragma once

#include "formats/core/vec.h"

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

}  // namespace oriel
