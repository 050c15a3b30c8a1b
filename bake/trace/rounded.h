// The rounded surface that vertex normals stand for, where a facet would show in light that comes from one direction.
#pragma once

#include <array>
#include <span>

#include "bake/trace/path.h"
#include "bake/trace/polygon_light.h"

namespace oriel {

// How far the rounded surface lies over a point of a triangle, m along the geometric normal of the side meant (Hanika
// 2021, "Hacking the shadow terminator", Ray Tracing Gems II). 0 where the facet is flat, hollow, or turned by so much
// from its normals that they smooth an edge that is one.
float height_of_rounded(const Scene& scene, std::uint32_t triangle, const Vec3& point, const Vec3& geometric_normal);

// What receives light there; rays start at its position.
inline Receiver receiver_of(const SurfacePoint& s) {
  return {spawn_origin(s, s.geometric_normal), s.normal, s.geometric_normal, s.rounded};
}

// incidence() of light that a point, a spot or a sun sends from ω (unit), of which nothing is mirrored: light of one
// direction would jump from facet to facet of a hollow.
inline float punctual_incidence(const Receiver& r, const Vec3& direction) {
  if (glm::dot(r.horizon(), direction) <= 0) return 0;
  return std::max(0.0f, glm::dot(r.normal, direction));
}

// The ways a shadow ray goes from r.position: straight, or, where the facet is turned away, by way of the rounded
// surface.
class ShadowLegs {
 public:
  ShadowLegs(const Receiver& r, const Ray& ray) : rays_{ray} {
    if (glm::dot(r.geometric_normal, ray.direction) > 0) return;
    rays_[1] = ray;
    rays_[1].origin = r.position + r.rounded * r.geometric_normal;
    if (ray.max_distance < Ray().max_distance) {  // not from afar: it ends at the same place
      const Vec3 to = ray.max_distance * ray.direction - r.rounded * r.geometric_normal;
      rays_[1].max_distance = glm::length(to);
      rays_[1].direction = to / rays_[1].max_distance;
    }
    rays_[0].direction = r.geometric_normal;
    rays_[0].max_distance = r.rounded;
    count_ = 2;
  }
  std::span<const Ray> rays() const { return {rays_.data(), count_}; }
  int count() const { return static_cast<int>(count_); }

 private:
  std::array<Ray, 2> rays_;
  std::size_t count_ = 1;
};

}  // namespace oriel
