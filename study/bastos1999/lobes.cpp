#include "study/bastos1999/lobes.h"

#include <algorithm>

namespace oriel::study {
namespace {

float unit(float x) {
  return x > 0 ? std::min(x, 1.0f) : 0.0f;
}

}  // namespace

double gaussian_d(double cos_theta, double alpha) {
  if (cos_theta <= 0) return 0;
  const double angle = std::acos(std::min(cos_theta, 1.0)) / alpha;
  return std::exp(-angle * angle) / (kPiD * alpha * alpha);
}

double v_cavity_g(const DVec3& wo, const DVec3& wi, const DVec3& h) {
  const double both = 2 * h.z / glm::dot(wo, h);
  return std::clamp(std::min(both * wo.z, both * wi.z), 0.0, 1.0);
}

LobeFunction cook_torrance_lobe(Facets facets, double alpha) {
  return [=, beckmann = Microfacet(FacetModel::kBeckmann, alpha)](const DVec3& wo, const DVec3& wi, const DVec3& h) {
    if (wi.z <= 0) return 0.0;
    const double d = facets == Facets::kBeckmann ? beckmann.d(h) : gaussian_d(h.z, alpha);
    return d * v_cavity_g(wo, wi, h) / (4 * wo.z);
  };
}

Vec3 equation_4(const SpecularLayers& layers, double cos_theta) {
  const Vec3 coat = layers.coat > 0 ? layers.coat * specular_fresnel(layers.coat_lobe(), cos_theta) : Vec3(0);
  const Vec3 f = coat + (Vec3(1) - coat) * specular_fresnel(layers.base, cos_theta);
  return glm::clamp(f / static_cast<float>(std::max(cos_theta * cos_theta, 1e-6)), Vec3(0), Vec3(1));
}

float sphere_map_cos_theta(float r) {
  return 1 - unit(r) * unit(r);
}

SphereMap make_sphere_map(std::uint32_t side, const std::function<Vec3(double cos_theta)>& reflectance) {
  SphereMap map{side, {}};
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x) {
      const Vec2 p = (Vec2(x, y) + 0.5f) / static_cast<float>(side) * 2.0f - 1.0f;
      map.texels.push_back(reflectance(sphere_map_cos_theta(glm::length(p))));
    }
  return map;
}

Vec3 sphere_lookup(const SphereMap& map, float cos_theta) {
  if (map.texels.empty()) return Vec3(0);
  const auto last = static_cast<float>(map.side - 1);
  const float r = std::sqrt(1 - unit(cos_theta)), x = (r + 1) * 0.5f * static_cast<float>(map.side) - 0.5f;
  const float y = 0.5f * last, left = std::clamp(std::floor(x), 0.0f, last), low = std::floor(y);
  const auto at = [&](float i, float j) {
    return map
        .texels[static_cast<std::size_t>(std::min(j, last)) * map.side + static_cast<std::size_t>(std::min(i, last))];
  };
  const float fx = std::clamp(x - left, 0.0f, 1.0f), fy = y - low;
  return glm::mix(glm::mix(at(left, low), at(left + 1, low), fx),
                  glm::mix(at(left, low + 1), at(left + 1, low + 1), fx), fy);
}

}  // namespace oriel::study
