#include "bake/trace/emission.h"

#include <algorithm>

#include "bake/scene/shade.h"
#include "bake/trace/warp.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

// Adds a weight to cumulative sums; false where it is nothing.
bool add_weight(double weight, std::vector<double>& cdf) {
  if (!(weight > 0) || !std::isfinite(weight)) return false;
  cdf.push_back((cdf.empty() ? 0 : cdf.back()) + weight);
  return true;
}

}  // namespace

Sources::Sources(const Scene& scene, const LightSet& lights) : scene_(scene), lights_(lights) {
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    const SceneMaterial& material = scene.material_of(t);
    if (material.unlit || max_component(material.emission) <= 0) continue;
    const double exitance = kPiD * luminance(mean_emission(scene, t)) * (material.double_sided ? 2 : 1);
    if (add_weight(exitance * triangle_area(scene, t), near_cdf_)) near_.push_back({false, t});
  }
  for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
    const Light& light = scene.lights[i];
    if (light.type == LightType::kDirectional) {
      if (add_weight(luminance(light.intensity), directional_cdf_)) directional_.push_back(i);
    } else if (add_weight(luminance(punctual_power(scene, light)), near_cdf_)) {
      near_.push_back({true, i});
    }
  }
  if (!near_.empty()) kinds_.push_back(SourceKind::kNear);
  if (!directional_.empty()) kinds_.push_back(SourceKind::kDirectional);
  if (lights.samples_sky() || luminance(scene.sky) > 0) kinds_.push_back(SourceKind::kSky);
}

Sources::Choice Sources::choose(const std::vector<double>& cdf, float u) {
  const auto at = std::upper_bound(cdf.begin(), cdf.end(), static_cast<double>(u) * cdf.back()) - cdf.begin();
  const std::size_t i = std::min(static_cast<std::size_t>(at), cdf.size() - 1);
  return {i, static_cast<float>((cdf[i] - (i > 0 ? cdf[i - 1] : 0)) / cdf.back())};
}

Particle Sources::emit(SourceKind kind, Sampler& sampler) const {
  if (kind == SourceKind::kNear) return emit_near(sampler);
  const float u = sampler.next1();
  const Vec2 towards = sampler.next2(), through = sampler.next2();
  if (kind == SourceKind::kDirectional) {
    const Choice chosen = choose(directional_cdf_, u);
    const LightSample sun = lights_.sample_light(directional_[chosen.index], Vec3(0), towards);
    Particle particle = from_afar(sun.direction, sun.estimate / chosen.probability, through);
    particle.punctual = true;
    return particle;
  }
  if (lights_.samples_sky()) {
    const LightSample sky = lights_.sample_sky(towards);
    return from_afar(sky.direction, sky.estimate, through);
  }
  return from_afar(square_to_sphere(towards), 4 * kPi * scene_.sky, through);
}

Particle Sources::emit_near(Sampler& sampler) const {
  const Choice chosen = choose(near_cdf_, sampler.next1());
  const Near& near = near_[chosen.index];
  Particle p =
      near.punctual ? emit_punctual(scene_.lights[near.index], sampler.next2()) : emit_triangle(near.index, sampler);
  p.power /= chosen.probability;
  p.group = near.punctual ? scene_.lights[near.index].light_group : scene_.light_group(near.index);
  return p;
}

Particle Sources::emit_triangle(std::uint32_t triangle, Sampler& sampler) const {
  const SceneMaterial& material = scene_.material_of(triangle);
  const Vec2 barycentric = square_to_triangle(sampler.next2());
  const bool front = !material.double_sided || sampler.next1() < 0.5f;
  const Vec3 normal = geometric_normal(scene_, triangle) * (front ? 1.0f : -1.0f);
  const Vec3 direction = glm::normalize(frame_from_normal(normal) * square_to_cosine_hemisphere(sampler.next2()));
  const auto area = static_cast<float>(triangle_area(scene_, triangle) * (material.double_sided ? 2 : 1));
  return {{spawn_origin(scene_, triangle, barycentric, direction), direction},
          shade_point(scene_, triangle, barycentric).emission * (kPi * area)};
}

Particle Sources::emit_punctual(const Light& light, const Vec2& v) const {
  const bool cone = light.type == LightType::kSpot && light.profile < 0;
  const Vec3 direction = cone ? sample_cone(light.direction, light.outer_cone_rad, v) : square_to_sphere(v);
  const float solid_angle = cone ? 2 * kPi * (1 - std::cos(light.outer_cone_rad)) : 4 * kPi;
  return {{light.position, direction}, punctual_intensity(scene_, light, direction) * solid_angle, true};
}

// A little beyond the bounds, so that rounding leaves nothing out.
float Sources::afar_radius() const {
  return 1.001f * scene_.radius();
}

// irradiance: on a plane that faces the source.
Particle Sources::from_afar(const Vec3& to_source, const Vec3& irradiance, const Vec2& v) const {
  const float radius = afar_radius();
  const Vec2 disk = square_to_disk(v);
  const Vec3 centre = 0.5f * (scene_.lower + scene_.upper);
  const Vec3 origin = centre + radius * (frame_from_normal(to_source) * Vec3(disk, 1));
  return {{origin, -to_source}, irradiance * (kPi * radius * radius), false, true};
}

}  // namespace oriel
