// The sphere as a square: the eight faces of an octahedron seen from +z, its lower half folded out. The centre is +z,
// the corners are -z. Two mappings that differ within the faces: the straight one projects onto |x| + |y| + |z| = 1
// (Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit Vectors"; the same maths as
// shaders/lib/octahedral.glsl), the equal-area one keeps all areas.
#pragma once

#include <cmath>

#include "formats/core/vec.h"

namespace oriel {

// Between the upper half, the diamond in the middle, and the lower one, the corners. 0 counts as positive.
template <class T>
glm::vec<2, T> octahedral_folded(const glm::vec<2, T>& p) {
  return {std::copysign(1 - std::abs(p.y), p.x), std::copysign(1 - std::abs(p.x), p.y)};
}

// Straight: the point of [-1, 1]² of a direction of any length. (0, 0) for no direction.
template <class T>
glm::vec<2, T> octahedral_from_direction(const glm::vec<3, T>& d) {
  const T sum = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
  if (!(sum > 0)) return glm::vec<2, T>(0);
  const glm::vec<2, T> p(d.x / sum, d.y / sum);
  return d.z < 0 ? octahedral_folded(p) : p;
}

// On the octahedron, not of length 1. p: in [-1, 1]².
template <class T>
glm::vec<3, T> direction_from_octahedral(const glm::vec<2, T>& p) {
  const T z = 1 - std::abs(p.x) - std::abs(p.y);
  return {z < 0 ? octahedral_folded(p) : p, z};
}

// Equal-area: even points of the square are even directions, texels are solid angles of one size (Clarberg 2008, "Fast
// Equal-Area Mapping of the (Hemi)Sphere using SIMD"). u in [0,1]².
inline Vec3 sphere_from_square(const Vec2& u) {
  const Vec2 p = 2.0f * u - 1.0f;
  const float side = 1 - (std::abs(p.x) + std::abs(p.y));  // from the equator: > 0 in the upper half
  const float r = 1 - std::abs(side);
  const float phi = r > 0 ? ((std::abs(p.y) - std::abs(p.x)) / r + 1) * (kPi / 4) : 0;
  const float sine = r * std::sqrt(std::max(0.0f, 2 - r * r));
  return {std::copysign(std::cos(phi), p.x) * sine, std::copysign(std::sin(phi), p.y) * sine,
          std::copysign(1 - r * r, side)};
}

// The inverse, of a unit direction.
inline Vec2 square_from_sphere(const Vec3& d) {
  const float r = std::sqrt(std::max(0.0f, 1 - std::abs(d.z)));
  const float v = r * std::atan2(std::abs(d.y), std::abs(d.x)) * (2 / kPi), u = r - v;
  const Vec2 p = d.z < 0 ? Vec2(1 - v, 1 - u) : Vec2(u, v);
  return 0.5f * Vec2(std::copysign(p.x, d.x), std::copysign(p.y, d.y)) + 0.5f;
}

// Of both: the texel of a map of side² texels that lies at `at`, where the map goes on over its edges: a row or column
// beyond one is that within it, the other way round. at: each from -side to 2 side - 1.
inline IVec2 wrap_octahedral(IVec2 at, int side) {
  for (int axis = 0; axis < 2; ++axis)
    if (at[axis] < 0 || at[axis] >= side) {
      at[axis] = at[axis] < 0 ? -1 - at[axis] : 2 * side - 1 - at[axis];
      at[1 - axis] = side - 1 - at[1 - axis];
    }
  return at;
}

}  // namespace oriel
