// Pixels of a radiance map as points in space: the same maths as shaders/lib/reprojection.glsl.
// Reflector space throughout: the plane is z = 0, the reflected world z > 0, the maps' eyes z < 0.
#pragma once

#include "formats/core/vec.h"

namespace oriel {

// The point that a pixel saw, homogeneous: xyz / w, or the direction xyz where w = 0. on_plane: where the pixel's ray
// crosses the plane; disparity as in RadianceMap.
inline Vec4 map_point(const Vec3& eye, const Vec2& on_plane, float disparity) {
  return Vec4(disparity * eye + Vec3(on_plane, 0) - eye, disparity);
}
// How far a step in clip space moves the picture, in pixels.
inline Vec2 screen_step(const Vec4& clip, const Vec4& clip_step, const Vec2& viewport) {
  const Vec2 moved = Vec2(clip_step) * clip.w - Vec2(clip) * clip_step.w;
  return 0.5f * viewport * moved / (clip.w * clip.w);
}
inline float covering_size(const Vec2& a, const Vec2& b) {
  return std::fmax(std::fabs(a.x) + std::fabs(b.x), std::fabs(a.y) + std::fabs(b.y));
}

}  // namespace oriel
