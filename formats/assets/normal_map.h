// Normal maps: how a texel tilts a surface's normal (docs/notes/conventions.md, "Normal maps").
// shaders/lib/normal_map.glsl is the same.
#pragma once

#include "formats/core/vec.h"

namespace oriel {

// The tangent of a surface with unit normal n from two steps on it, that do not lie on one line, and the changes of the
// texture coordinates (v down) over them. xyz lies along ∂p/∂u and has any length; w = 1 or -1 says on which side the
// bitangent w · cross(n, xyz) lies: that of -∂p/∂v, up in the image. xyz = 0 where the coordinates do not span a plane.
inline Vec4 tangent_of_steps(const Vec3& n, const Vec3& step_a, const Vec3& step_b, const Vec2& uv_a,
                             const Vec2& uv_b) {
  const float turn = uv_a.x * uv_b.y - uv_a.y * uv_b.x;
  const float sign = turn > 0 ? 1.0f : turn < 0 ? -1.0f : 0.0f;
  const Vec3 along_u = sign * (uv_b.y * step_a - uv_a.y * step_b), along_v = sign * (uv_a.x * step_b - uv_b.x * step_a);
  return Vec4(along_u, glm::dot(glm::cross(n, along_u), along_v) > 0 ? -1 : 1);
}

// The unit normal that the texel (RGB as stored, [0,1]) makes of the unit normal n, with x and y scaled. n itself where
// the tangent has no direction across n or the texel says nothing.
inline Vec3 tilted_normal(const Vec3& n, const Vec4& tangent, const Vec3& texel, float scale) {
  const Vec3 size = glm::abs(Vec3(tangent));
  const Vec3 unit = Vec3(tangent) / std::max(max_component(size), 1e-30f);  // its square would underflow
  const Vec3 across = unit - glm::dot(n, unit) * n;
  const float length = glm::length(across);
  if (!(length > 1e-6f)) return n;
  const Vec3 t = across / length, b = tangent.w * glm::cross(n, t);
  const Vec3 local = 2.0f * texel - 1.0f;
  const Vec3 tilted = scale * (local.x * t + local.y * b) + std::max(local.z, 0.0f) * n;
  const float size2 = length2(tilted);
  return size2 > 1e-12f ? tilted / std::sqrt(size2) : n;
}

}  // namespace oriel
