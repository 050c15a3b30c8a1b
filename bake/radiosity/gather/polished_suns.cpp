#include "bake/radiosity/gather/polished_suns.h"

#include <algorithm>
#include <cmath>

#include "bake/trace/albedo.h"
#include "bake/trace/path.h"
#include "bake/trace/warp.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr double kCalibrationRays = 1 << 17;  // of all triangles together, about
constexpr int kMaxRaysATriangle = 64;         // of one
constexpr double kUnseen = 0.02;              // visibility of a triangle where no ray found the sun

// The unoccluded flux of a sun that a triangle reflects, luminance, lm.
double reflected(const Scene& scene, std::uint32_t triangle, const Light& sun) {
  const SceneMaterial& material = scene.material_of(triangle);
  float cosine = glm::dot(geometric_normal(scene, triangle), -sun.direction);
  if (material.double_sided && !material.solid) cosine = std::abs(cosine);
  if (!(cosine > 0)) return 0;
  const ShadePoint point = shade_point(scene, triangle, Vec2(1 / 3.0f));
  return luminance(sun.intensity * reflectance(point, cosine)) * double{cosine} * triangle_area(scene, triangle);
}

}  // namespace

PolishedSuns::PolishedSuns(const Accel& accel, const LightSet& lights, std::uint64_t seed, std::uint64_t& rays)
    : accel_(accel), lights_(lights) {
  const Scene& scene = accel.scene();
  std::vector<double> weights;
  double all = 0;
  for (std::uint32_t l = 0; l < scene.lights.size(); ++l) {
    if (scene.lights[l].type != LightType::kDirectional) continue;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
      if (!is_polished(scene.material_of(t))) continue;
      const double weight = reflected(scene, t, scene.lights[l]);
      if (!(weight > 0) || !std::isfinite(weight)) continue;
      targets_.push_back({t, l}), weights.push_back(weight);
      all += weight;
    }
  }
  // A triangle too small for its own rays takes the last visibility measured on its surface: meshes list neighbours
  // together.
  double sum = 0, owed = 0, seen = 1;
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    const auto surface = [&](std::size_t of) { return scene.triangle_surface[targets_[of].triangle]; };
    if (i == 0 || targets_[i].light != targets_[i - 1].light || surface(i) != surface(i - 1)) seen = 1;
    owed += kCalibrationRays * weights[i] / all;
    if (const int tries = static_cast<int>(std::min(owed, double{kMaxRaysATriangle})); tries > 0) {
      owed = 0, seen = 0;
      for (int k = 0; k < tries; ++k) {
        Sampler sampler(seed, i, static_cast<std::uint32_t>(k));
        seen += max_component(start_on(targets_[i], sampler, rays).particle.power) > 0 ? 1.0 / tries : 0.0;
      }
    }
    cdf_.push_back(sum += weights[i] * std::max(kUnseen, seen));
  }
}

PolishedSuns::Start PolishedSuns::emit(Sampler& sampler, std::uint64_t& rays) const {
  const double at = double{sampler.next1()} * cdf_.back();
  const std::size_t i = std::min<std::size_t>(
      static_cast<std::size_t>(std::upper_bound(cdf_.begin(), cdf_.end(), at) - cdf_.begin()), cdf_.size() - 1);
  Start start = start_on(targets_[i], sampler, rays);
  start.particle.power /= static_cast<float>((cdf_[i] - (i > 0 ? cdf_[i - 1] : 0)) / cdf_.back());
  return start;
}

// A particle at a random point of the triangle, with the flux that the sun brings there.
PolishedSuns::Start PolishedSuns::start_on(const Target& target, Sampler& sampler, std::uint64_t& rays) const {
  const Scene& scene = accel_.scene();
  const Vec2 at = square_to_triangle(sampler.next2());
  const Vec3 point = point_on(scene, target.triangle, at);
  const LightSample sun = lights_.sample_light(target.light, point, sampler.next2());
  Start start;
  start.triangle = target.triangle;
  const float cosine = glm::dot(geometric_normal(scene, target.triangle), sun.direction);
  const SceneMaterial& material = scene.material_of(target.triangle);
  if (!(cosine > 0) && (!material.double_sided || material.solid)) return start;
  const Vec3 origin = spawn_origin(scene, target.triangle, at, sun.direction);
  ++rays;
  const Vec3 lux = sun.estimate * accel_.transmittance({origin, sun.direction, sun.distance, true, false});
  const auto area = static_cast<float>(triangle_area(scene, target.triangle));
  start.particle = {{origin, -sun.direction}, lux * (std::abs(cosine) * area)};
  start.particle.punctual = true;
  start.particle.group = sun.group;
  return start;
}

}  // namespace oriel
