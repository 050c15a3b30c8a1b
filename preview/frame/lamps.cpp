#include "preview/frame/lamps.h"

#include <algorithm>

#include "bake/scene/shade.h"
#include "bake/scene/sky.h"
#include "bake/trace/accel.h"
#include "bake/trace/punctual.h"
#include "bake/trace/sampler.h"
#include "bake/trace/warp.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr std::uint32_t kSky = ~0u;
// How far points are off their lamp, in radii of the scene: the lamp's own triangles then lie behind them. A place
// without size is moved as far aside, so that no edge lies exactly in a plane with eye and light.
constexpr float kOff = 1e-5f;
constexpr std::uint64_t kNearStream = 1, kFarStream = 2;

bool shines(const SceneMaterial& material) {
  return !material.unlit && max_component(material.emission) > 0;
}

}  // namespace

Lamps::Lamps(const Scene& scene) : scene_(&scene) {
  const auto add = [&](const Near& near, double lumens) {
    if (!(lumens > 0) || !std::isfinite(lumens)) return;
    near_.push_back(near);
    near_cdf_.push_back((near_cdf_.empty() ? 0 : near_cdf_.back()) + lumens);
  };
  for (const Surface& surface : scene.surfaces) {
    const SceneMaterial& material = scene.materials[surface.material];
    if (!shines(material)) continue;
    ++count_;
    for (std::uint32_t t = surface.first_triangle; t < surface.first_triangle + surface.triangle_count; ++t) {
      const double lumens = kPiD * triangle_area(scene, t) * luminance(DVec3(mean_emission(scene, t)));
      add({false, t, false}, lumens);
      if (material.double_sided) add({false, t, true}, lumens);
    }
  }
  for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
    const Light& light = scene.lights[i];
    ++count_;
    if (light.type != LightType::kDirectional)
      add({true, i, false}, luminance(punctual_power(scene, light)));
    else if (luminance(light.intensity) > 0)
      afar_.push_back(i);
  }
  if (luminance(scene.sky) > 0) afar_.push_back(kSky), ++count_;
  if (!scene.sky_image.texels.empty()) sky_ = SkySampler(scene.sky_image);
}

// at: [0,1) of all lumens. The point stands for 1 / count of them.
LampPoint Lamps::near_point(double at, const Vec2& on, float count) const {
  const double wanted = at * near_cdf_.back();
  const auto found = std::upper_bound(near_cdf_.begin(), near_cdf_.end(), wanted) - near_cdf_.begin();
  const std::size_t i = std::min(static_cast<std::size_t>(found), near_cdf_.size() - 1);
  const double lumens = near_cdf_[i] - (i > 0 ? near_cdf_[i - 1] : 0);
  const auto share = static_cast<float>(near_cdf_.back() / lumens) / count;  // 1 / (probability of the lamp, count)
  const float off = kOff * scene_->radius();
  LampPoint point;
  if (near_[i].punctual) {
    const Light& light = scene_->lights[near_[i].index];
    point.kind = LampKind::kPunctual;
    point.place = Vec4(light.position + off * square_to_sphere(on), 1);
    point.normal = light.direction;
    point.power = share * (light.profile >= 0 ? light.color : light.intensity);
    point.light = near_[i].index;
    point.lamp = static_cast<std::uint32_t>(scene_->surfaces.size()) + point.light;
    point.share = share;
    return point;
  }
  const std::uint32_t t = near_[i].index;
  const Vec2 barycentric = square_to_triangle(on);
  point.lamp = scene_->triangle_surface[t];
  point.normal = geometric_normal(*scene_, t) * (near_[i].back ? -1.0f : 1.0f);
  point.place = Vec4(point_on(*scene_, t, barycentric) + off * point.normal, 1);
  point.power = share * static_cast<float>(triangle_area(*scene_, t)) * shade_point(*scene_, t, barycentric).emission;
  return point;
}

LampPoint Lamps::sky_point(const Vec2& on, float count) const {
  LampPoint point;
  point.kind = LampKind::kAfar;
  point.lamp = static_cast<std::uint32_t>(scene_->surfaces.size() + scene_->lights.size());
  if (sky_.empty()) {
    point.place = Vec4(square_to_sphere(on), 0);
    point.power = scene_->sky * (4 * kPi / count);
    return point;
  }
  const SkySampler::Sample sample = sky_.sample(on);
  point.place = Vec4(sample.direction, 0);
  if (sample.pdf > 0) point.power = sky_radiance(*scene_, sample.direction) / (sample.pdf * count);
  return point;
}

std::vector<LampPoint> Lamps::points(std::uint64_t seed, std::uint32_t pass, std::uint32_t count) const {
  std::vector<LampPoint> points;
  const std::size_t kinds = afar_.size() + (near_.empty() ? 0 : 1);
  if (kinds == 0) return points;
  const auto each = std::max<std::uint32_t>(1, count / static_cast<std::uint32_t>(kinds));
  const auto n = static_cast<float>(each);
  for (std::uint32_t i = 0; i < each; ++i) {
    if (!near_.empty()) {
      Sampler sampler(seed, kNearStream, pass * each + i);
      const float at = sampler.next1();
      points.push_back(near_point(at, sampler.next2(), n));
    }
    for (std::size_t k = 0; k < afar_.size(); ++k) {
      Sampler sampler(seed, kFarStream + k, pass * each + i);
      const Vec2 on = sampler.next2();
      if (afar_[k] == kSky) {
        points.push_back(sky_point(on, n));
        continue;
      }
      const Light& sun = scene_->lights[afar_[k]];
      const float angle = std::max(sun.angular_radius_rad, kOff);
      LampPoint& point = points.emplace_back();
      point.kind = LampKind::kAfar;
      point.place = Vec4(sample_cone(-sun.direction, angle, on), 0);
      point.power = sun.intensity * (2 / (1 + std::cos(angle)) / n);
      point.lamp = static_cast<std::uint32_t>(scene_->surfaces.size()) + afar_[k];
    }
  }
  std::erase_if(points, [](const LampPoint& p) { return !(max_component(p.power) > 0); });
  return points;
}

}  // namespace oriel
