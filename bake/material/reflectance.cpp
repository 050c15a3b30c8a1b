#include "bake/material/reflectance.h"

#include <algorithm>

#include "bake/trace/albedo.h"

namespace oriel {
namespace {

float unit(float x) {
  return x > 0 ? std::min(x, 1.0f) : 0.0f;
}  // NaN: 0

Vec3 albedo(const Vec3& f0, float f90, float alpha, float cos_theta) {
  const Vec2 split = specular_albedo(cos_theta, alpha);
  const Vec3 r = f0 * split.x + Vec3(f90 * split.y);
  return {unit(r.r), unit(r.g), unit(r.b)};
}

}  // namespace

float sphere_map_cos_theta(float r) {
  return 1 - unit(r) * unit(r);
}

FresnelMap make_fresnel_map(const Vec3& f0, float f90, float alpha, std::uint32_t table_size,
                            std::uint32_t sphere_size) {
  const Vec3 low(unit(f0.r), unit(f0.g), unit(f0.b));
  const float high = unit(f90);
  FresnelMap map;
  map.alpha = unit(alpha);
  map.sphere_size = sphere_size;
  const std::uint32_t n = std::max(table_size, 2u);
  map.table.reserve(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    const float root = static_cast<float>(i) / static_cast<float>(n - 1);
    map.table.push_back(albedo(low, high, map.alpha, root * root));
  }
  map.sphere.reserve(std::size_t{sphere_size} * sphere_size);
  for (std::uint32_t y = 0; y < sphere_size; ++y)
    for (std::uint32_t x = 0; x < sphere_size; ++x) {
      const Vec2 p = (Vec2(x, y) + 0.5f) / static_cast<float>(sphere_size) * 2.0f - 1.0f;
      map.sphere.push_back(albedo(low, high, map.alpha, sphere_map_cos_theta(glm::length(p))));
    }
  return map;
}

Vec3 fresnel_lookup(const FresnelMap& map, float cos_theta) {
  if (map.table.empty()) return Vec3(0);
  const auto last = map.table.size() - 1;
  const float x = std::sqrt(unit(cos_theta)) * static_cast<float>(last);
  const auto i = std::min(static_cast<std::size_t>(x), last);
  return glm::mix(map.table[i], map.table[std::min(i + 1, last)], x - static_cast<float>(i));
}

}  // namespace oriel
