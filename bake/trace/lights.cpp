#include "bake/trace/lights.h"

#include <algorithm>

#include "bake/scene/shade.h"
#include "bake/trace/warp.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

// KHR_lights_punctual's spot falloff: smooth between the cones.
float spot_falloff(const Light& light, const Vec3& towards_light) {
  const float cos_outer = std::cos(light.outer_cone_rad), cos_inner = std::cos(light.inner_cone_rad);
  const float cosine = glm::dot(light.direction, -towards_light);
  const float t = std::clamp((cosine - cos_outer) / std::max(1e-3f, cos_inner - cos_outer), 0.0f, 1.0f);
  return t * t;
}

// lm
DVec3 punctual_power(const Light& light) {
  const DVec3 intensity(light.intensity);
  if (light.type == LightType::kPoint) return 4 * kPiD * intensity;
  const double ci = std::cos(light.inner_cone_rad), co = std::cos(light.outer_cone_rad);
  return 2 * kPiD * ((1 - ci) + (ci - co) / 3) * intensity;  // ∫ t² over the falloff, t linear in the cosine
}

// How far off its plane an emitter's sampled point may lie by rounding, as offset_origin reckons it.
float emitter_margin(const Scene& scene, std::uint32_t triangle) {
  float magnitude = 0;
  for (int i = 0; i < 3; ++i)
    magnitude = std::max(magnitude, max_component(glm::abs(scene.positions[scene.triangles[triangle][i]])));
  return magnitude * (32 * 0x1p-24f);
}

}  // namespace

LightSet::LightSet(const Scene& scene) : scene_(&scene) {
  std::vector<char> emits(scene.materials.size());
  bool any = false;
  for (std::size_t m = 0; m < emits.size(); ++m) {
    const SceneMaterial& material = scene.materials[m];
    any |= emits[m] = !material.unlit && max_component(material.emission) > 0;
  }
  if (any) triangle_pdf_.assign(scene.triangles.size(), 0);
  for (std::uint32_t t = 0; any && t < scene.triangles.size(); ++t) {
    const std::uint32_t m = scene.surfaces[scene.triangle_surface[t]].material;
    if (!emits[m]) continue;
    const double area = triangle_area(scene, t) * (scene.materials[m].double_sided ? 2 : 1);
    const DVec3 flux = kPiD * area * DVec3(mean_emission(scene, t));
    power_ += flux;
    add({false, t, 0, geometric_normal(scene, t), emitter_margin(scene, t), scene.materials[m].double_sided},
        luminance(Vec3(flux)));
  }
  for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
    const Light& light = scene.lights[i];
    if (light.type == LightType::kDirectional) {
      const double r = scene.radius();
      add({true, i, 0, {}, 0, false},
          luminance(light.intensity) * kPiD * r * r);  // what falls on the scene's bounding disk
    } else {
      const DVec3 flux = punctual_power(light);
      power_ += flux;
      add({true, i, 0, {}, 0, false}, luminance(Vec3(flux)));
    }
  }
  const double total = cdf_.empty() ? 0 : cdf_.back();
  for (std::size_t i = 0; i < picks_.size(); ++i) {
    Pick& pick = picks_[i];
    pick.probability = static_cast<float>((cdf_[i] - (i > 0 ? cdf_[i - 1] : 0)) / total);
    if (!pick.punctual)
      triangle_pdf_[pick.index] = pick.probability / static_cast<float>(triangle_area(scene, pick.index));
  }
}

void LightSet::add(const Pick& pick, double weight) {
  if (!(weight > 0) || !std::isfinite(weight)) return;
  picks_.push_back(pick);
  cdf_.push_back((cdf_.empty() ? 0 : cdf_.back()) + weight);
}

LightSample LightSet::sample(const Vec3& p, float u, const Vec2& v) const {
  if (picks_.empty()) return {};
  const auto at = std::upper_bound(cdf_.begin(), cdf_.end(), static_cast<double>(u) * cdf_.back());
  const Pick& pick = picks_[std::min<std::size_t>(at - cdf_.begin(), picks_.size() - 1)];
  return pick.punctual ? sample_punctual(pick, p) : sample_triangle(pick, p, v);
}

LightSample LightSet::sample_triangle(const Pick& pick, const Vec3& p, const Vec2& v) const {
  LightSample s;
  const Vec2 barycentric = square_to_triangle(v);
  const Vec3 to = point_on(*scene_, pick.index, barycentric) - p;
  const float d2 = length2(to);
  if (!(d2 > 0)) return s;
  s.distance = std::sqrt(d2);
  s.direction = to / s.distance;
  const float cosine = -glm::dot(pick.normal, s.direction);
  if (pick.double_sided ? cosine == 0 : cosine <= 0) return s;
  s.pdf = triangle_pdf_[pick.index] * d2 / std::abs(cosine);
  s.estimate = shade_point(*scene_, pick.index, barycentric).emission / s.pdf;
  s.distance -= s.distance * 0x1p-14f + pick.margin / std::abs(cosine);  // stop short of the emitter itself
  return s;
}

LightSample LightSet::sample_punctual(const Pick& pick, const Vec3& p) const {
  const Light& light = scene_->lights[pick.index];
  LightSample s;
  if (light.type == LightType::kDirectional) {
    s.direction = -light.direction;
    s.estimate = light.intensity / pick.probability;
    return s;
  }
  const Vec3 to = light.position - p;
  const float d2 = length2(to);
  if (!(d2 > 0)) return s;
  s.distance = std::sqrt(d2);
  s.direction = to / s.distance;
  const float falloff = light.type == LightType::kSpot ? spot_falloff(light, s.direction) : 1.0f;
  s.estimate = light.intensity * (falloff / d2 / pick.probability);
  return s;
}

LightSample LightSet::sample_light(std::uint32_t light, const Vec3& p, const Vec2&) const {
  Pick pick{};
  pick.punctual = true;
  pick.index = light;
  pick.probability = 1;
  return sample_punctual(pick, p);
}

float LightSet::pdf(const Vec3& p, std::uint32_t triangle, const Vec3& on, const Vec3& normal) const {
  if (triangle_pdf_.empty() || triangle_pdf_[triangle] == 0) return 0;
  const Vec3 to = on - p;
  const float d2 = length2(to);
  const float cosine = std::abs(glm::dot(normal, to)) / std::sqrt(d2);
  return cosine > 0 ? triangle_pdf_[triangle] * d2 / cosine : 0;
}

}  // namespace oriel
