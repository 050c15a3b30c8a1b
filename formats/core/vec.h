// The project's names for GLM's types. GLM types are never written to a file as they lie in memory.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace oriel {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using Vec4 = glm::vec4;
using Mat3 = glm::mat3;
using Mat4 = glm::mat4;
using DVec2 = glm::dvec2;
using DVec3 = glm::dvec3;
using DVec4 = glm::dvec4;
using DMat3 = glm::dmat3;
using DMat4 = glm::dmat4;
using IVec2 = glm::ivec2;
using UVec2 = glm::uvec2;
using UVec3 = glm::uvec3;

inline constexpr float kPi = 3.14159265358979323846f;
inline constexpr double kPiD = 3.14159265358979323846;

inline float length2(const Vec3& v) {
  return glm::dot(v, v);
}
inline float max_component(const Vec3& v) {
  return std::max(v.x, std::max(v.y, v.z));
}
inline bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// The unit vector along v, or fallback where v has no direction (zero, denormal or not finite).
inline Vec3 normalize_or(const Vec3& v, const Vec3& fallback) {
  const DVec3 d(v);
  const double l2 = glm::dot(d, d);
  return l2 > 0 && std::isfinite(l2) ? Vec3(d / std::sqrt(l2)) : fallback;
}

// An orthonormal basis with z = n (unit). Columns: tangent, bitangent, n; world = frame * local.
// Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
inline Mat3 frame_from_normal(const Vec3& n) {
  const float sign = std::copysign(1.0f, n.z);
  const float a = -1.0f / (sign + n.z);
  const float b = n.x * n.y * a;
  return Mat3(Vec3(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x), Vec3(b, sign + n.y * n.y * a, -n.y), n);
}

}  // namespace oriel
