// The sphere as a square: eight triangles of an octahedron, all areas kept (Clarberg 2008, "Fast Equal-Area Mapping of
// the (Hemi)Sphere using SIMD"). Even points of the square are even directions; texels are solid angles of one size.
#pragma once

#include "formats/core/vec.h"

namespace oriel {

// u in [0,1]². The centre is +z, the corners are -z.
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

// The texel of a map of side² texels that lies at (x, y), up to one texel beyond the map's edges, where the map goes on
// at the edge's mirror image.
inline IVec2 wrap_octahedral(IVec2 at, int side) {
  for (int axis = 0; axis < 2; ++axis)
    if (at[axis] < 0 || at[axis] >= side) {
      at[axis] = at[axis] < 0 ? -1 - at[axis] : 2 * side - 1 - at[axis];
      at[1 - axis] = side - 1 - at[1 - axis];
    }
  return at;
}

}  // namespace oriel
