// Generation of gather rays at sample points.
#pragma once

#include <utility>

#include "bake/radiosity/texels/texels.h"
#include "bake/trace/warp.h"

namespace oriel {

// A sample point with its tangent frame, for many rays.
class GatherPoint {
 public:
  GatherPoint() = default;
  explicit GatherPoint(const SamplePoint& point)
      : frame_(frame_from_normal(point.normal)), point_(point), tilted_(point.normal != point.geometric_normal) {}

  // A ray with a cosine distribution about the shading normal. A direction below the geometric surface is mirrored to
  // above it, or leaves from the rounded one. u: [0,1)².
  Ray ray(const Vec2& u) const {
    Vec3 direction = frame_ * square_to_cosine_hemisphere(u);
    if (tilted_)
      if (const float height = glm::dot(direction, point_.geometric_normal); height < 0) {
        if (point_.rounded > 0) return {over(), direction};
        direction -= 2 * height * point_.geometric_normal;
      }
    return {point_.origin, direction};
  }
  // A ray to a point, as ray() may give it, and the distance to it, m; distance 0 if no ray leads there.
  std::pair<Ray, float> ray_to(const Vec3& point) const {
    const bool above = glm::dot(point - point_.origin, point_.geometric_normal) > 0;
    const Vec3 origin = above ? point_.origin : over(), off = point - origin;
    const float distance = glm::length(off);
    if (!(distance > 0) || !(glm::dot(off, point_.receiver().horizon()) > 0)) return {};
    return {Ray{origin, off / distance}, distance};
  }
  // The clamped cosine of that direction: π times the density of ray() there.
  float incidence(const Vec3& direction) const {
    return std::max(oriel::incidence(point_.receiver(), direction), 1e-12f);
  }

 private:
  Vec3 over() const { return point_.origin + point_.rounded * point_.geometric_normal; }  // on the rounded surface

  Mat3 frame_{1};
  SamplePoint point_;
  bool tilted_ = false;
};

// All texels in an order for coherent rays: by page, chart and blocks of 8 x 8 texels.
std::vector<std::uint32_t> coherent_order(const Texels& texels);

}  // namespace oriel
