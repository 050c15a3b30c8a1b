#include "bake/trace/albedo.h"

#include <algorithm>
#include <vector>

#include "bake/trace/bsdf.h"
#include "bake/trace/sampler.h"

namespace oriel {
namespace {

constexpr int kCosines = 64;  // entry i at cosθ = (i / (n-1))²: dense at grazing angles, where it bends
constexpr int kWidths = 33;   // entry j at roughness j / (n-1), alpha its square
constexpr std::uint32_t kSamples = 512;

// ∫ G2 D F / (4 cosθo) dω split by Schlick's weight; with visible normals each sample weighs G2/G1.
Vec2 integrate(float cos_theta, float alpha) {
  const Vec3 wo(std::sqrt(std::max(0.0f, 1 - cos_theta * cos_theta)), 0, cos_theta);
  DVec2 sum(0);
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    Sampler sampler(0, 0, i);
    const Vec3 h = sample_ggx_visible_normal(wo, alpha, sampler.next2());
    const Vec3 wi = 2 * glm::dot(wo, h) * h - wo;
    if (wi.z <= 0) continue;
    const float weight = smith_g2(wo.z, wi.z, alpha) / smith_g1(wo.z, alpha);
    const float schlick = std::pow(1 - std::clamp(glm::dot(wo, h), 0.0f, 1.0f), 5.0f);
    sum += DVec2(weight * (1 - schlick), weight * schlick);
  }
  return Vec2(sum / static_cast<double>(kSamples));
}

std::vector<Vec2> make_table() {
  std::vector<Vec2> table(kCosines * kWidths);
  for (int j = 0; j < kWidths; ++j) {
    const float roughness = static_cast<float>(j) / (kWidths - 1);
    for (int i = 0; i < kCosines; ++i) {
      const float root = static_cast<float>(i) / (kCosines - 1);
      const float cosine = std::max(1e-4f, root * root);
      const float schlick = std::pow(1 - cosine, 5.0f);
      table[j * kCosines + i] = j == 0 ? Vec2(1 - schlick, schlick) : integrate(cosine, roughness * roughness);
    }
  }
  return table;
}

}  // namespace

Vec2 specular_albedo(float cos_theta, float alpha) {
  static const std::vector<Vec2> table = make_table();
  const float x = std::sqrt(std::clamp(cos_theta, 0.0f, 1.0f)) * (kCosines - 1);
  const float y = std::sqrt(std::clamp(alpha, 0.0f, 1.0f)) * (kWidths - 1);
  const int i = std::min(static_cast<int>(x), kCosines - 2), j = std::min(static_cast<int>(y), kWidths - 2);
  const float fx = x - static_cast<float>(i), fy = y - static_cast<float>(j);
  const Vec2* row = &table[j * kCosines + i];
  return glm::mix(glm::mix(row[0], row[1], fx), glm::mix(row[kCosines], row[kCosines + 1], fx), fy);
}

Vec3 reflectance(const ShadePoint& point, float cos_theta) {
  if (point.f90 <= 0 && max_component(point.f0) <= 0) return Vec3(0);
  const Vec2 ab = specular_albedo(cos_theta, point.alpha);
  return glm::clamp(point.f0 * ab.x + Vec3(point.f90 * ab.y), Vec3(0), Vec3(1));
}

Vec3 straight_transmittance(const ShadePoint& point, float cos_theta) {
  const Vec3 through = point.transmission * (1 - max_component(reflectance(point, cos_theta)));
  return Vec3(1 - point.coverage) + point.coverage * through;
}

}  // namespace oriel
