// Gather rays: where they leave a texel and which way.
#pragma once

#include <utility>

#include "bake/radiosity/texels/texels.h"
#include "bake/trace/warp.h"

namespace oriel {

// A site made ready for many rays.
class GatherSite {
 public:
  GatherSite() = default;
  explicit GatherSite(const SamplePoint& site)
      : frame_(frame_from_normal(site.normal)), site_(site), tilted_(site.normal != site.geometric_normal) {}

  // Cosine-distributed about the site's normal, mirrored above the real surface where it falls below. u: [0, 1)².
  Ray ray(const Vec2& u) const {
    Vec3 direction = frame_ * square_to_cosine_hemisphere(u);
    if (tilted_)
      if (const float height = glm::dot(direction, site_.geometric_normal); height < 0)
        direction -= 2 * height * site_.geometric_normal;
    return {site_.origin, direction};
  }
  // Towards a point, and how far; 0: it lies below the surface.
  std::pair<Ray, float> ray_to(const Vec3& point) const {
    const Vec3 off = point - site_.origin;
    const float distance = glm::length(off);
    if (!(distance > 0) || !(glm::dot(off, site_.geometric_normal) > 0)) return {};
    return {Ray{site_.origin, off / distance}, distance};
  }
  // π times the density of that direction.
  float incidence(const Vec3& direction) const {
    return std::max(oriel::incidence(site_.receiver(), direction), 1e-12f);
  }

 private:
  Mat3 frame_{1};
  SamplePoint site_;
  bool tilted_ = false;
};

// The order in which texels are traced: neighbours come together.
std::vector<std::uint32_t> coherent_order(const Texels& texels);

}  // namespace oriel
