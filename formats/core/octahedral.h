// Directions on a square: the octahedron |x| + |y| + |z| = 1 seen from +z, its lower half folded out (Cigolle et al.
// 2014, "A Survey of Efficient Representations for Independent Unit Vectors"). The same maths as
// shaders/lib/octahedral.glsl.
#pragma once

#include <cmath>

#include "formats/core/vec.h"

namespace oriel {

// Between the upper half, the diamond in the middle, and the lower one, the corners. 0 counts as positive.
template <class T>
glm::vec<2, T> octahedral_folded(const glm::vec<2, T>& p) {
  return {std::copysign(1 - std::abs(p.y), p.x), std::copysign(1 - std::abs(p.x), p.y)};
}

// The point of [-1, 1]² of a direction of any length; the centre is +z, the corners are -z. (0, 0) for no direction.
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

// Where texel (x, y) of a map of size² lies that goes on over its edges: a row or column beyond one is that within it,
// the other way round. at: each from -size to 2 size - 1.
inline IVec2 octahedral_wrapped(IVec2 at, int size) {
  const auto reflected = [size](int v) { return v < 0 ? -1 - v : 2 * size - 1 - v; };
  if (at.x < 0 || at.x >= size) at = {reflected(at.x), size - 1 - at.y};
  if (at.y < 0 || at.y >= size) at = {size - 1 - at.x, reflected(at.y)};
  return at;
}

}  // namespace oriel
