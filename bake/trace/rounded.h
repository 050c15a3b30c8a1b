// The rounded surface that vertex normals stand for, where a facet would show in light that comes from one direction.
#pragma once

#include "bake/trace/path.h"
#include "bake/trace/polygon_light.h"

namespace oriel {

// How far the rounded surface lies over a point of a surface, m along its geometric normal (Hanika 2021, "Hacking the
// shadow terminator", Ray Tracing Gems II). 0 where the facet is flat, hollow, or turned by so much from its normals
// that they smooth an edge that is one; or where something stands in the way there, as light would leak past it.
float height_of_rounded(const Accel& accel, const SurfacePoint& surface);

// What receives light there; rays start at its position.
inline Receiver receiver_of(const SurfacePoint& s) {
  return {spawn_origin(s, s.geometric_normal), s.normal, s.geometric_normal, s.rounded};
}

// The ray that goes from the receiver to where `ray` ends, which starts at its position: from the rounded surface where
// the facet is turned away.
inline Ray leaving(const Receiver& r, Ray ray) {
  if (!(r.rounded > 0) || glm::dot(r.geometric_normal, ray.direction) > 0) return ray;
  ray.origin += r.rounded * r.geometric_normal;
  if (ray.max_distance < Ray().max_distance) {  // not from afar
    const Vec3 to = ray.max_distance * ray.direction - r.rounded * r.geometric_normal;
    ray.max_distance = glm::length(to);
    ray.direction = to / ray.max_distance;
  }
  return ray;
}

}  // namespace oriel
