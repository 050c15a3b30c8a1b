#include "bake/transfer/probe_rays.h"

#include <algorithm>

#include "bake/scene/sky.h"
#include "bake/trace/albedo.h"
#include "bake/transfer/probes.h"
#include "formats/core/octahedral.h"
#include "formats/core/sh.h"

namespace oriel {
namespace {

constexpr int kMaxLayers = 16;              // of surfaces that a ray passes
constexpr float kMostBacks = 0.25f;         // of a valid probe's rays
constexpr std::uint32_t kDiskSamples = 16;  // of a light with a size
constexpr std::uint32_t kPolygonSamples = 64;
constexpr float kFaint = 1e-3f;  // what a ray need not follow

class ProbeRays {
 public:
  ProbeRays(const ProbeScene& scene, const Vec3& position, LightsAt lights, std::uint64_t& rays)
      : scene_(scene), position_(position), lights_(std::move(lights)), rays_(rays) {
    count_ = static_cast<std::size_t>(sh_count(scene.options.bands));
    for (auto& sum : sums_) sum.resize(3 * count_);
    y_.resize(count_);
  }

  struct Seen {
    Vec3 radiance{0};
    Vec3 passed{1};  // share of light from beyond all surfaces; 0 where one is in the way
    float distance = 3e38f;
    bool back = false;
  };
  Seen look(const Vec3& direction) const {
    const Scene& scene = scene_.accel.scene();
    Seen seen;
    Ray ray{position_, direction};
    for (int layer = 0; layer < kMaxLayers; ++layer) {
      const Hit hit = scene_.accel.intersect(ray);
      ++rays_;
      if (!hit) return seen;
      const SceneMaterial& material = scene.material_of(hit.triangle);
      const bool back = !hit.front && !material.double_sided;
      Vec3 through(0);
      float coverage = 1;
      if (may_transmit(material)) {
        const ShadePoint point = shade_point(scene, hit.triangle, hit.barycentric);
        coverage = point.coverage;
        through = straight_transmittance(point, std::abs(glm::dot(geometric_normal(scene, hit.triangle), direction)));
      }
      if (!back && coverage > 0)
        seen.radiance += seen.passed * coverage * scene_.radiance(hit, -direction, holds(hit.triangle));
      seen.passed *= through;
      if (max_component(seen.passed) < kFaint) {
        seen.passed = Vec3(0);
        seen.distance = glm::length(point_on(scene, hit.triangle, hit.barycentric) - position_);
        seen.back = back;
        return seen;
      }
      ray.origin = spawn_origin(scene, hit.triangle, hit.barycentric, direction);
    }
    seen.passed = Vec3(0);
    return seen;
  }

  // Adds light from one direction: radiance times solid angle.
  void add(const Vec3& direction, const Vec3& light, std::uint32_t half) {
    if (!(max_component(light) > 0) || !is_finite(light)) return;
    evaluate_sh(direction, y_);
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < count_; ++i)
        sums_[half & 1][c * count_ + i] += static_cast<double>(light[static_cast<int>(c)]) * y_[i];
  }

  // Emissive polygons too large to be left to chance.
  void add_polygons(std::uint64_t stream) {
    std::uint64_t number = 0;
    for (const PolygonLight* polygon : lights_.sampled) {
      const std::uint64_t seed = mix64(scene_.seed ^ mix64(++number));
      const Vec3 towards = normalize_or(polygon->center - position_, -polygon->normal);
      for (std::uint32_t s = 0; s < kPolygonSamples; ++s) {
        Sampler sampler(seed, stream, s);
        const auto sample = sample_polygon(*polygon, {position_, towards, towards}, sampler.next2());
        if (!sample) continue;
        ++rays_;
        const Vec3 passed = scene_.accel.transmittance({position_, sample->direction, sample->distance});
        add(sample->direction, passed * polygon->radiance * (2 * sample->solid_angle / kPolygonSamples), s);
      }
    }
  }

  // Lights that no ray meets.
  void add_punctual(std::uint64_t stream) {
    const Scene& scene = scene_.accel.scene();
    for (std::uint32_t l = 0; l < scene.lights.size(); ++l) {
      if (const int place = scene_.bright.of_light(l); place >= 0 && (lights_.kept >> place & 1) == 0) continue;
      const std::uint32_t samples = scene.lights[l].angular_radius_rad > 0 ? kDiskSamples : 1;
      for (std::uint32_t s = 0; s < samples; ++s) {
        Sampler sampler(mix64(scene_.seed + l), stream, s);
        const LightSample sample = scene_.lights.sample_light(l, position_, sampler.next2());
        if (!(max_component(sample.estimate) > 0)) continue;
        ++rays_;
        const Vec3 light = sample.estimate *
                           scene_.accel.transmittance({position_, sample.direction, sample.distance}) /
                           static_cast<float>(samples);
        for (const std::uint32_t half : {0u, 1u}) add(sample.direction, light, half);
      }
    }
  }

  // A sky image: its own samples and the rays that meet it, weighted by the balance heuristic (Veach 1997).
  void add_sky(const UVec2& shift) {
    const float share = 2.0f / static_cast<float>(scene_.options.samples);  // of a half's samples
    for (std::uint32_t s = 0; s < scene_.options.samples; ++s) {
      const LightSample sky = scene_.lights.sample_sky(scene_.net.point(s, shift));
      if (!(sky.pdf > 0)) continue;
      const Vec3 passed = scene_.accel.transmittance({position_, sky.direction});
      ++rays_;
      add(sky.direction, sky.estimate * passed * (share * sky.pdf / (sky.pdf + kEvenPdf)), s);
    }
  }
  Vec3 sky_beyond(const Seen& seen, const Vec3& direction) const {
    if (!(max_component(seen.passed) > 0)) return Vec3(0);
    const Vec3 radiance = sky_radiance(scene_.accel.scene(), direction);
    const bool sampled = scene_.lights.samples_sky();
    return seen.passed * radiance * (sampled ? kEvenPdf / (kEvenPdf + scene_.lights.sky_pdf(direction)) : 1.0f);
  }

  void finish(MeasuredProbe& out) const {
    for (std::size_t i = 0; i < 3 * count_; ++i) {
      const double a = sums_[0][i], b = sums_[1][i];
      out.probe.sh.push_back(static_cast<float>(0.5 * (a + b)));
      out.squared_difference += (a - b) * (a - b);
      out.squared_sum += (a + b) * (a + b);
    }
  }

  static constexpr float kEvenPdf = 1 / (4 * kPi);

 private:
  bool holds(std::uint32_t triangle) const {
    const PolygonLight* polygon = scene_.bright.of_triangle(triangle);
    return !polygon || std::find(lights_.unrayed.begin(), lights_.unrayed.end(), polygon) == lights_.unrayed.end();
  }

  const ProbeScene& scene_;
  Vec3 position_;
  LightsAt lights_;
  std::uint64_t& rays_;
  std::size_t count_;
  std::vector<double> sums_[2];  // of even and odd samples
  std::vector<float> y_;
};

}  // namespace

MeasuredProbe measure_probe(const ProbeScene& scene, const Vec3& position, std::uint64_t stream, std::uint64_t& rays) {
  const ShiftedNet& net = scene.net;
  MeasuredProbe out;
  out.probe.position = position;
  LightsAt lights = scene.bright.at(position, stream);
  out.probe.bright = lights.bright;
  out.probe.kept = lights.kept;
  ProbeRays around(scene, position, std::move(lights), rays);
  const std::uint32_t side = scene.options.depth_side, samples = scene.options.samples;
  std::vector<Vec2> depth(std::size_t{side} * side);
  std::vector<float> counts(depth.size());
  const UVec2 shift = net.shift(2 * stream);
  std::uint32_t backs = 0;
  for (std::uint32_t s = 0; s < samples; ++s) {
    const Vec2 u = net.point(s, shift);
    const Vec3 direction = sphere_from_square(u);
    const ProbeRays::Seen seen = around.look(direction);
    backs += seen.back;
    const Vec3 radiance = seen.radiance + around.sky_beyond(seen, direction);
    around.add(direction, radiance * (2 / (ProbeRays::kEvenPdf * static_cast<float>(samples))), s);
    const UVec2 texel = glm::min(UVec2(u * static_cast<float>(side)), UVec2(side - 1));
    const std::size_t at = std::size_t{texel.y} * side + texel.x;
    const float share = std::min(1.0f, seen.distance / scene.depth_cap_m);
    depth[at] += Vec2(share, share * share);
    counts[at] += 1;
  }
  around.add_polygons(stream);
  around.add_punctual(stream);
  if (scene.lights.samples_sky()) around.add_sky(net.shift(2 * stream + 1));
  for (std::size_t i = 0; i < depth.size(); ++i) depth[i] /= std::max(1.0f, counts[i]);
  out.probe.depth = std::move(depth);
  out.probe.valid = static_cast<float>(backs) < kMostBacks * static_cast<float>(samples);
  around.finish(out);
  return out;
}

}  // namespace oriel
