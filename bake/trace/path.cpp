#include "bake/trace/path.h"

#include <utility>

#include "bake/trace/albedo.h"
#include "bake/trace/glass.h"
#include "bake/trace/sampled_lights.h"
#include "bake/trace/shading.h"
#include "bake/trace/warp.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr float kMostPaths = 16;  // that one splits into at a time

FromEmitter sample_lights_bsdf(const Tracing& by, const SurfacePoint& surface, const Shading& shading) {
  return sample_lights(
      by, surface, [&](const Vec3& wi, bool punctual) { return shading.eval(wi, punctual); },
      [&](const Vec3& wi) { return shading.pdf(wi); });
}

// One path, vertex by vertex.
class PathTracer {
 public:
  PathTracer(const Transport& t, Sampler& sampler, std::uint64_t& rays, const OnDiffuse* on_diffuse = nullptr)
      : t_(t), sampler_(sampler), rays_(rays), on_diffuse_(on_diffuse), mirrored_(on_diffuse != nullptr) {}

  // It is what an eye sees.
  void show_to_eyes(bool through_frosted = false) { eyes_ = true, spread_ = through_frosted; }
  // The path goes on by a sample of a surface's lobes.
  void leave(const SurfacePoint& surface, const BsdfSample& sample) {
    const bool refracted = sample.lobe == Lobe::kRefraction;
    eyes_ = eyes_ && sample.lobe != Lobe::kDiffuse;
    mirrored_ = mirrored_ && !(is_frosted(surface.shade) && (refracted || surface.shade.inside));
    spread_ = spread_ && sample.lobe == Lobe::kTransmission;  // what a mirror shows glows on its own
    medium_.leave(surface.shade, refracted);
    radiance_scale_ *= sample.radiance_scale;
  }

  PathLight follow(const Ray& ray, float bsdf_pdf, int bounce, const Vec3& throughput) {
    ++rays_;
    return follow_from(ray, t_.accel.intersect(ray), bsdf_pdf, bounce, throughput);
  }

  PathLight follow_from(const Ray& ray, const Hit& hit, float bsdf_pdf, int bounce, const Vec3& throughput) {
    const PathLight light = walk(ray, hit, bsdf_pdf, bounce, throughput);
    if (is_usable(light.emitted) && is_usable(light.sky) && is_usable(light.scattered) && is_usable(light.lamps))
      return light;
    t_.accel.dropped().add(hit.triangle);
    return {.back_face = light.back_face};
  }

 private:
  enum class Step { kEnd, kPassed, kBounced };

  PathLight walk(Ray ray, Hit hit, float bsdf_pdf, int bounce, const Vec3& throughput) {
    PathLight light;
    throughput_ = throughput;
    from_ = ray.origin;
    pdf_ = bsdf_pdf;
    int passes = 0;
    bool first = bounce == 0;
    for (; passes < kMaxPasses; ++rays_, hit = t_.accel.intersect(ray)) {
      if (!hit) {
        const float weight = pdf_ > 0 ? balance(pdf_, t_.lights.pdf(ray.direction)) : 1.0f;
        const Vec3 sky = throughput_ * sky_radiance(t_.accel.scene(), ray.direction) * weight;
        (first ? light.sky : light.scattered) += sky;
        record(t_, first ? PathGroups::kSky : PathGroups::kScattered, sky_owner(t_.accel.scene()), ray.direction, sky);
        break;
      }
      SurfacePoint surface = surface_at(t_.accel, hit, ray.direction);
      throughput_ *= medium_.passed(t_.accel.scene(), hit);
      if (eyes_ && t_.options.unlit_white > 0 && t_.accel.scene().material_of(hit.triangle).unlit) {
        light.scattered += throughput_ * t_.options.unlit_white * surface.shade.base_color;
        break;
      }
      if (surface.shade.coverage < 1 && sampler_.next1() >= surface.shade.coverage) {
        ray.origin = spawn_origin(surface, ray.direction);
        ++passes;
        continue;
      }
      if (surface.emits) {
        const float weight =
            pdf_ > 0 ? balance(pdf_, t_.lights.pdf(from_, hit.triangle, surface.position, surface.geometric_normal))
                     : 1.0f;
        const bool lamp = mirrored_ && t_.lights.samples(hit.triangle);
        const Vec3 emission = throughput_ * surface.shade.emission * weight;
        (first ? light.emitted : lamp ? light.lamps : light.scattered) += emission;
        if (t_.grouped)
          t_.grouped->add(first  ? PathGroups::kEmitted
                          : lamp ? PathGroups::kLamps
                                 : PathGroups::kScattered,
                          t_.accel.scene().light_group(hit.triangle), emission);
      }
      if (!surface.reflects) {
        light.back_face = first && passes == 0;
        break;
      }
      if (bounce >= t_.options.max_bounces) break;
      const Step step = scatter(surface, ray, hit.distance, bounce, light);
      if (step == Step::kEnd) break;
      if (step == Step::kPassed) {
        ++passes;
        continue;
      }
      first = false;
      passes = 0;
      if (++bounce >= t_.options.roulette_from && !survive()) break;
      split(ray, bounce, light);
    }
    return light;
  }

  // Lobes are sampled a little less often than they reflect: in a box of metal, where light dies out after hundreds of
  // bounces, few paths would bring it all. One that weighs as much as several goes on as so many.
  void split(const Ray& ray, int bounce, PathLight& light) {
    const float weight = max_component(throughput_) / radiance_scale_;
    if (!(weight >= 2) || !is_usable(throughput_)) return;
    const int paths = static_cast<int>(std::min(weight, kMostPaths));
    throughput_ /= static_cast<float>(paths);
    for (int k = 1; k < paths; ++k) {
      const PathLight other = PathTracer(*this).follow(ray, pdf_, bounce, throughput_);
      light.scattered += other.scattered;
      light.lamps += other.lamps;
    }
  }

  // Tells the diffuse reflection; where it is taken over a surface without it is left. False where nothing else
  // reflects.
  bool tell_diffuse(SurfacePoint& surface, const Vec3& wo, float distance) {
    const float cosine = glm::dot(surface.normal, wo);
    const Vec3 specular = reflectance(surface.shade, cosine);
    const Vec3 weight = throughput_ * surface.shade.diffuse * (1 - max_component(specular));
    std::optional<float> survival = 1.0f;
    if (max_component(weight) > 0 && is_usable(weight))
      survival = (*on_diffuse_)({surface.triangle, surface.barycentric, surface.front, distance, weight});
    if (!survival) {
      mirrored_ = false;
      return true;
    }
    surface.shade.diffuse = Vec3(0);
    // The rest goes on as often as it is bright, or as told.
    const float often = std::max(1.0f, *survival * max_component(throughput_));
    const float q = std::min(1.0f, max_component(specular) * often + max_component(surface.shade.transmission));
    if (!(q > 0) || sampler_.next1() >= q) return false;
    throughput_ /= q;
    return true;
  }

  // Light sampling at the surface, then the next ray.
  Step scatter(SurfacePoint& surface, Ray& ray, float distance, int bounce, PathLight& light) {
    const bool mirrored = mirrored_;
    if (on_diffuse_ && !tell_diffuse(surface, -ray.direction, distance)) return Step::kEnd;
    const Shading shading(surface, -ray.direction);
    const FromEmitter from = sample_lights_bsdf({t_, sampler_, rays_}, surface, shading);
    (mirrored_ && from.lamp ? light.lamps : light.scattered) += throughput_ * from.light;
    record(t_, mirrored_ && from.lamp ? PathGroups::kLamps : PathGroups::kScattered, from.group, from.direction,
           throughput_ * from.light);
    sample_virtual(
        {t_, sampler_, rays_, !eyes_}, surface, t_.options.max_bounces - bounce - 1,
        [&](const Vec3& wi, bool punctual) { return shading.eval(wi, punctual); },
        [&](const Vec3&, std::uint32_t group, const Vec3& other) {
          light.scattered += throughput_ * other;
          if (t_.grouped) t_.grouped->add(PathGroups::kScattered, group, throughput_ * other);
        });
    const float u = sampler_.next1();
    const auto sample = shading.sample(u, sampler_.next2());
    if (!sample) return Step::kEnd;
    const bool passes = sample->lobe == Lobe::kTransmission;
    const bool spreads = passes && sees_frosted(surface);
    const Vec3 direction = !passes   ? shading.world(*sample)
                           : spreads ? shading.spread(sampler_.next2())
                                     : ray.direction;
    leave(surface, *sample);
    throughput_ *= sample->weight;
    if (!(max_component(throughput_) > 0)) return Step::kEnd;
    if (spreads) light.scattered += glow(surface, shading);
    ray = {spawn_origin(surface, direction), direction};
    // Straight transmission continues the same segment: light sampling from the last vertex sees through glass too.
    if (passes) {
      mirrored_ = mirrored;
      return Step::kPassed;
    }
    from_ = ray.origin;
    pdf_ = sample->delta ? 0 : shading.pdf(direction);
    return Step::kBounced;
  }

  // Panes behind the first one let what shines on it pass straight, and have no glow of their own.
  Vec3 glow(const SurfacePoint& pane, const Shading& shading) {
    if (std::exchange(spread_, true)) return Vec3(0);
    return throughput_ * sample_behind({t_, sampler_, rays_}, pane, shading);
  }

  // Beyond a glossy lobe light sampling stands in for a part of what is met, and looks straight through.
  bool sees_frosted(const SurfacePoint& surface) const {
    return eyes_ && t_.options.frosted_panes && !(pdf_ > 0) && is_frosted_pane(surface.shade);
  }

  bool survive() {
    const float q = std::min(1.0f, max_component(throughput_) / radiance_scale_);
    if (sampler_.next1() >= q) return false;
    throughput_ /= q;
    return true;
  }

  const Transport& t_;
  Sampler& sampler_;
  std::uint64_t& rays_;
  const OnDiffuse* on_diffuse_;
  bool eyes_ = false;    // it is what an eye sees: unlit surfaces show, frosted panes blur
  bool spread_ = false;  // by a frosted pane
  bool mirrored_;        // no diffuse vertex so far was followed, nor light through frosted glass
  Vec3 throughput_{1};
  Vec3 from_{0};   // last vertex that chose a direction
  float pdf_ = 0;  // with this density
  Medium medium_;
  float radiance_scale_ = 1;  // in throughput_: BsdfSample::radiance_scale
};

// Light from lamps and by one sampled lobe; on_diffuse: may be null.
PathLight reflect_light(const Tracing& by, const SurfacePoint& surface, const Vec3& wo, const OnDiffuse* on_diffuse) {
  const Transport& t = by.transport;
  Sampler& sampler = by.sampler;
  std::uint64_t& rays = by.rays;
  PathLight light;
  if (!surface.reflects) return light;
  const Shading shading(surface, wo);
  const FromEmitter from = sample_lights_bsdf(by, surface, shading);
  (on_diffuse && from.lamp ? light.lamps : light.scattered) += from.light;
  record(t, from.lamp ? PathGroups::kLamps : PathGroups::kScattered, from.group, from.direction, from.light);
  sample_virtual(
      by, surface, t.options.max_bounces - 1, [&](const Vec3& wi, bool punctual) { return shading.eval(wi, punctual); },
      [&](const Vec3&, std::uint32_t group, const Vec3& other) {
        light.scattered += other;
        if (t.grouped) t.grouped->add(PathGroups::kScattered, group, other);
      });
  const float u = sampler.next1();
  const auto sample = shading.sample(u, sampler.next2());
  if (!sample || sample->lobe == Lobe::kTransmission || sample->lobe == Lobe::kRefraction) return light;
  const Vec3 direction = shading.above(sample->wi);
  const Ray ray{spawn_origin(surface, direction), direction};
  const float pdf = sample->delta ? 0 : shading.pdf(direction);
  PathTracer path(t, sampler, rays, on_diffuse);
  path.show_to_eyes();
  path.leave(surface, *sample);
  const PathLight rest = path.follow(ray, pdf, 1, sample->weight);
  light.scattered += rest.scattered;
  light.lamps += rest.lamps;
  return light;
}

}  // namespace

PathLight trace_path(const Transport& t, const Ray& ray, float bsdf_pdf, Sampler& sampler, std::uint64_t& rays) {
  PathTracer path(t, sampler, rays);
  path.show_to_eyes();
  return path.follow(ray, bsdf_pdf, 0, Vec3(1));
}

PathLight trace_to_diffuse(const Transport& t, const TracedRay& traced, Sampler& sampler, std::uint64_t& rays,
                           const OnDiffuse& on_diffuse) {
  const auto& [ray, hit, bsdf_pdf] = traced;
  return PathTracer(t, sampler, rays, &on_diffuse).follow_from(ray, hit, bsdf_pdf, 0, Vec3(1));
}

Vec3 reflected_light(const Transport& t, const SurfacePoint& surface, const Vec3& wo, Sampler& sampler,
                     std::uint64_t& rays) {
  return reflect_light({t, sampler, rays}, surface, wo, nullptr).scattered;
}

Vec3 refracted_light(const Transport& t, const SurfacePoint& surface, const Vec3& wo, Sampler& sampler,
                     std::uint64_t& rays) {
  const Shading shading(surface, wo);
  PathTracer path(t, sampler, rays);
  path.show_to_eyes(is_frosted_pane(surface.shade));
  if (is_frosted_pane(surface.shade)) {
    const Vec3 direction = shading.spread(sampler.next2());
    const Vec3 passed =
        surface.shade.transmission * (1 - max_component(reflectance(surface.shade, glm::dot(surface.normal, wo))));
    const Vec3 glow = passed * sample_behind({t, sampler, rays}, surface, shading);
    return glow + path.follow({spawn_origin(surface, direction), direction}, 0, 1, passed).scattered;
  }
  const auto sample = shading.refracted(sampler.next2());
  if (!sample || !(max_component(sample->weight) > 0)) return Vec3(0);
  const Vec3 direction = shading.world(*sample);
  path.leave(surface, *sample);
  return path.follow({spawn_origin(surface, direction), direction}, 0, 1, sample->weight).scattered;
}

PathLight specular_light(const Transport& t, const ReflectingPoint& seen, Sampler& sampler, std::uint64_t& rays,
                         const OnDiffuse& on_diffuse) {
  SurfacePoint specular = seen.surface;
  specular.shade.diffuse = specular.shade.transmission = Vec3(0);
  return reflect_light({t, sampler, rays, true}, specular, seen.wo, &on_diffuse);
}

IrradianceSample sample_irradiance(const Transport& t, const SurfacePoint& surface, Sampler& sampler,
                                   std::uint64_t& rays, bool directional) {
  IrradianceSample s;
  const Tracing by{t, sampler, rays};
  const Shading shading(surface, surface.normal);
  const auto density = [&](const Vec3& wi) {
    return directional ? shading.reflected(wi, [](const Vec3& w) { return linear_hemisphere_pdf(w.z); })
                       : shading.cosine(wi) / kPi;
  };
  const auto add_moments = [&](const Vec3& estimate, const Vec3& from) {
    const float share = luminance(estimate) / (4 * kPi);
    s.mean += share;
    s.vector += share * from;
  };
  Vec3 towards(0);
  float light_cosine = 0;
  s.direct = sample_lights(
                 by, surface,
                 [&](const Vec3& wi, bool punctual) {
                   towards = wi;
                   light_cosine = shading.cosine(wi, punctual);
                   return Vec3(light_cosine);
                 },
                 density)
                 .light;
  if (directional && light_cosine > 0) add_moments(s.direct / light_cosine, towards);
  sample_virtual(
      by, surface, t.options.max_bounces,
      [&](const Vec3& wi, bool punctual) { return Vec3(light_cosine = shading.cosine(wi, punctual)); },
      [&](const Vec3& from, std::uint32_t, const Vec3& other) {
        s.direct += other;
        if (directional) add_moments(other / light_cosine, from);
      });
  const Vec2 u = sampler.next2();
  const Vec3 direction = shading.above(directional ? square_to_linear_hemisphere(u) : square_to_cosine_hemisphere(u));
  const Ray ray{spawn_origin(surface, direction), direction};
  const float pdf = std::max(density(direction), 1e-12f);
  const float weight = directional ? shading.cosine(direction) / pdf : kPi;  // cosθ / pdf
  const PathLight light = PathTracer(t, sampler, rays).follow(ray, pdf, 0, Vec3(1));
  s.direct += weight * (light.emitted + light.sky);
  s.indirect = weight * light.scattered;
  s.back_face = light.back_face;
  if (directional) add_moments((light.emitted + light.sky + light.scattered) / pdf, direction);
  if (is_usable(s.direct) && is_usable(s.indirect) && is_usable(s.vector)) return s;
  t.accel.dropped().add(surface.triangle);
  return {.back_face = light.back_face};
}

}  // namespace oriel
