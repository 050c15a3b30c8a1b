#include "bake/trace/lights.h"

#include <algorithm>

#include "bake/scene/shade.h"
#include "bake/trace/warp.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

// How far off its plane an emitter's sampled point may lie by rounding, as offset_origin reckons it.
float emitter_margin(const Scene& scene, std::uint32_t triangle) {
  float magnitude = 0;
  for (int i = 0; i < 3; ++i)
    magnitude = std::max(magnitude, max_component(glm::abs(scene.positions[scene.triangles[triangle][i]])));
  return magnitude * (32 * 0x1p-24f);
}

bool usable(double weight) {
  return weight > 0 && std::isfinite(weight);
}

BoundedLight triangle_bounds(const Scene& scene, std::uint32_t triangle, const Vec3& normal, bool double_sided,
                             double power) {
  const UVec3& t = scene.triangles[triangle];
  const Vec3 &a = scene.positions[t.x], &b = scene.positions[t.y], &c = scene.positions[t.z];
  return {glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c)), normal, double_sided ? kPi : 0, kPi / 2, power};
}

BoundedLight punctual_bounds(const Scene& scene, const Light& light, double power) {
  float reach = kPi;
  if (light.profile >= 0)
    reach = scene.profiles[static_cast<std::size_t>(light.profile)].vertical_deg.back() * (kPi / 180);
  else if (light.type == LightType::kSpot)
    reach = light.outer_cone_rad;
  return {light.position, light.position, light.direction, reach, 0, power};
}

// As if the sample's light had been chosen with a probability.
LightSample chosen_with(LightSample s, float probability) {
  s.estimate /= probability;
  s.pdf *= probability;
  return s;
}

}  // namespace

LightSet::LightSet(const Scene& scene, const Accel* accel) : scene_(&scene), mirrored_(scene) {
  std::vector<BoundedLight> bounds;
  add_triangles(bounds);
  add_lights(bounds);
  tree_ = LightTree(bounds);
  if (!scene.sky_image.texels.empty()) sky_ = SkySampler(scene.sky_image);
  if (!near_.empty()) kinds_.push_back(Kind::kNear);
  if (!directional_.empty()) kinds_.push_back(Kind::kDirectional);
  if (!sky_.empty()) kinds_.push_back(Kind::kSky);
  frosted_ = FrostedLights(scene, *this, accel);
}

void LightSet::add_triangles(std::vector<BoundedLight>& bounds) {
  const Scene& scene = *scene_;
  std::vector<char> emits(scene.materials.size());
  bool any = false;
  for (std::size_t m = 0; m < emits.size(); ++m) {
    const SceneMaterial& material = scene.materials[m];
    any |= emits[m] = !material.unlit && max_component(material.emission) > 0;
  }
  if (any) triangle_near_.assign(scene.triangles.size(), ~0u);
  for (std::uint32_t t = 0; any && t < scene.triangles.size(); ++t) {
    const std::uint32_t m = scene.surfaces[scene.triangle_surface[t]].material;
    if (!emits[m]) continue;
    const bool double_sided = scene.materials[m].double_sided;
    const double area = triangle_area(scene, t);
    const DVec3 flux = kPiD * area * (double_sided ? 2 : 1) * DVec3(mean_emission(scene, t));
    power_ += flux;
    const double weight = luminance(Vec3(flux));
    if (!usable(weight)) continue;
    const Vec3 normal = geometric_normal(scene, t);
    triangle_near_[t] = static_cast<std::uint32_t>(near_.size());
    near_.push_back({false, t, normal, static_cast<float>(area), emitter_margin(scene, t), double_sided});
    bounds.push_back(triangle_bounds(scene, t, normal, double_sided, weight));
  }
}

void LightSet::add_lights(std::vector<BoundedLight>& bounds) {
  for (std::uint32_t i = 0; i < scene_->lights.size(); ++i) {
    const Light& light = scene_->lights[i];
    if (light.type == LightType::kDirectional) {
      const double weight = luminance(light.intensity);
      if (!usable(weight)) continue;
      directional_.push_back(i);
      directional_cdf_.push_back((directional_cdf_.empty() ? 0 : directional_cdf_.back()) + weight);
      continue;
    }
    const DVec3 flux = punctual_power(*scene_, light);
    power_ += flux;
    const double weight = luminance(Vec3(flux));
    if (!usable(weight)) continue;
    near_.push_back({true, i, {}, 0, 0, false});
    bounds.push_back(punctual_bounds(*scene_, light, weight));
  }
}

LightSample LightSet::sample(const Vec3& p, float u, const Vec2& v) const {
  if (kinds_.empty()) return {};
  const auto count = static_cast<float>(kinds_.size());
  const std::size_t kind = std::min(static_cast<std::size_t>(u * count), kinds_.size() - 1);
  const float rest = std::clamp(u * count - static_cast<float>(kind), 0.0f, 1 - 0x1p-24f);
  switch (kinds_[kind]) {
    case Kind::kNear:
      return chosen_with(sample_near(p, rest, v), 1 / count);
    case Kind::kDirectional:
      return chosen_with(sample_directional(p, rest, v), 1 / count);
    case Kind::kSky:
      break;
  }
  return chosen_with(sample_sky(v), 1 / count);
}

LightSample LightSet::sample_near(const Vec3& p, float u, const Vec2& v) const {
  const LightTree::Pick pick = tree_.pick(p, u);
  const Near& near = near_[pick.light];
  LightSample sample = near.punctual ? sample_light(near.index, p, v) : sample_triangle(near, p, v);
  sample.near = true;
  return chosen_with(sample, pick.probability);
}

LightSample LightSet::sample_directional(const Vec3& p, float u, const Vec2& v) const {
  const std::vector<double>& cdf = directional_cdf_;
  const auto at = std::upper_bound(cdf.begin(), cdf.end(), static_cast<double>(u) * cdf.back()) - cdf.begin();
  const std::size_t i = std::min(static_cast<std::size_t>(at), cdf.size() - 1);
  LightSample sample = sample_light(directional_[i], p, v);
  sample.sun = true;
  return chosen_with(sample, static_cast<float>((cdf[i] - (i > 0 ? cdf[i - 1] : 0)) / cdf.back()));
}

LightSample LightSet::sample_triangle(const Near& near, const Vec3& p, const Vec2& v) const {
  LightSample s;
  const Vec2 barycentric = square_to_triangle(v);
  const Vec3 to = point_on(*scene_, near.index, barycentric) - p;
  const float d2 = length2(to);
  if (!(d2 > 0)) return s;
  s.distance = std::sqrt(d2);
  s.direction = to / s.distance;
  const float cosine = -glm::dot(near.normal, s.direction);
  if (near.double_sided ? cosine == 0 : cosine <= 0) return s;
  s.pdf = d2 / (near.area * std::abs(cosine));
  s.group = scene_->light_group(near.index);
  s.estimate = shade_point(*scene_, near.index, barycentric).emission / s.pdf;
  s.distance -= s.distance * 0x1p-14f + near.margin / std::abs(cosine);  // stop short of the emitter itself
  return s;
}

LightSample LightSet::sample_light(std::uint32_t index, const Vec3& p, const Vec2& v) const {
  const Light& light = scene_->lights[index];
  LightSample s;
  s.group = light.light_group;
  if (light.type == LightType::kDirectional) {
    s.direction = -light.direction;
    s.estimate = light.intensity;
    if (light.angular_radius_rad > 0) {
      // Radiance E / (π sin²a) over the density 1 / (2π (1 - cos a)): the facing plane gets E.
      s.direction = sample_cone(s.direction, light.angular_radius_rad, v);
      s.estimate *= 2 / (1 + std::cos(light.angular_radius_rad));
    }
    return s;
  }
  const Vec3 to = light.position - p;
  const float d2 = length2(to);
  if (!(d2 > 0)) return s;
  s.distance = std::sqrt(d2);
  s.direction = to / s.distance;
  s.estimate = punctual_intensity(*scene_, light, -s.direction) / d2;
  return s;
}

LightSample LightSet::sample_sky(const Vec2& v) const {
  const SkySampler::Sample sky = sky_.sample(v);
  LightSample s;
  s.direction = sky.direction;
  s.pdf = sky.pdf;
  s.group = sky_owner(*scene_);
  if (s.pdf > 0) s.estimate = sky_radiance(*scene_, s.direction) / s.pdf;
  return s;
}

float LightSet::pdf(const Vec3& p, std::uint32_t triangle, const Vec3& on, const Vec3& normal) const {
  if (triangle_near_.empty() || triangle_near_[triangle] == ~0u) return 0;
  const std::uint32_t near = triangle_near_[triangle];
  const Vec3 to = on - p;
  const float d2 = length2(to);
  const float cosine = std::abs(glm::dot(normal, to)) / std::sqrt(d2);
  if (!(cosine > 0)) return 0;
  return tree_.probability(p, near) / static_cast<float>(kinds_.size()) * d2 / (near_[near].area * cosine);
}

float LightSet::pdf(const Vec3& direction) const {
  return sky_.empty() ? 0 : sky_.pdf(direction) / static_cast<float>(kinds_.size());
}

}  // namespace oriel
