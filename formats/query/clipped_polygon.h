// Polygons as seen from the origin, clipped by planes through it, and Lambert's formula for them.
#pragma once

#include <array>
#include <cmath>

#include "formats/core/vec.h"

namespace oriel {

// Up to four corners, and one more for each of two planes.
struct ClippedPolygon {
  std::array<Vec3, 6> v;
  int count = 0;
};

// What lies on the side of n. At most two clips of four corners.
inline ClippedPolygon clip(const ClippedPolygon& in, const Vec3& n) {
  ClippedPolygon out;
  for (int i = 0; i < in.count; ++i) {
    const Vec3 &a = in.v[i], &b = in.v[i + 1 == in.count ? 0 : i + 1];
    const float da = glm::dot(a, n), db = glm::dot(b, n);
    if (da >= 0) out.v[out.count++] = a;
    if ((da > 0 && db < 0) || (da < 0 && db > 0)) out.v[out.count++] = a + (b - a) * (da / (da - db));
  }
  return out;
}

// Lambert's edge vector: the angle under which the edge is seen, along the normal of the plane through eye and edge.
inline Vec3 edge_vector(const Vec3& a, const Vec3& b) {
  const Vec3 normal = glm::cross(a, b);
  const float sine = glm::length(normal);
  return sine > 0 ? normal * (std::atan2(sine, glm::dot(a, b)) / sine) : Vec3(0);
}

// Its product with -n is the integral of n·ω over the polygon as seen (Lambert 1760): positive where the polygon is
// counter-clockwise from the origin's side. All of it lies on the side of n.
inline Vec3 polygon_vector(const ClippedPolygon& p) {
  Vec3 sum(0);
  for (int i = 0; i < p.count; ++i) sum += edge_vector(p.v[i], p.v[i + 1 == p.count ? 0 : i + 1]);
  return 0.5f * sum;
}

}  // namespace oriel
