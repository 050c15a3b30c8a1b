#include "bake/radiosity/gather/lamp_paths.h"

#include <algorithm>

#include "bake/jobs/units.h"
#include "bake/radiosity/gather/moments.h"
#include "bake/radiosity/texels/seeds.h"
#include "bake/trace/emission.h"
#include "bake/trace/glass.h"
#include "bake/trace/shading.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr std::uint64_t kUnit = 8192;  // particles
constexpr std::size_t kUnits = 128;    // whose light is buffered
constexpr float kMostParticles = 16;   // that one splits into at a time
constexpr std::uint32_t kNoTriangle = ~0u;
constexpr float kOften = 4;  // survival probability of further reflections over reflectance

// Light that arrived at a texel, from one particle or from a unit of them.
struct Arrival {
  std::uint32_t texel = 0;
  Vec3 light{0};    // lux
  Vec4 moments{0};  // as HalfSums'
};
void fields(Archive& archive, Arrival& a) {
  archive(a.texel, a.light, a.moments);
}

// Merges the arrivals of each texel: in metal boxes there are many.
void add_up(std::vector<Arrival>& arrivals) {
  std::stable_sort(arrivals.begin(), arrivals.end(),
                   [](const Arrival& a, const Arrival& b) { return a.texel < b.texel; });
  std::size_t merged = 0;
  for (std::size_t i = 0; i < arrivals.size(); ++i)
    if (merged > 0 && arrivals[merged - 1].texel == arrivals[i].texel)
      arrivals[merged - 1].light += arrivals[i].light, arrivals[merged - 1].moments += arrivals[i].moments;
    else
      arrivals[merged++] = arrivals[i];
  arrivals.resize(merged);
  arrivals.shrink_to_fit();
}

// The same by light group.
struct GroupedArrival {
  std::uint32_t texel = 0, group = 0;
  Vec3 light{0};
};
void fields(Archive& archive, GroupedArrival& a) {
  archive(a.texel, a.group, a.light);
}

// Appends the arrivals of one light group's particles.
void add_group_arrivals(std::span<const Arrival> arrivals, std::uint32_t group, std::vector<GroupedArrival>& grouped) {
  for (const Arrival& a : arrivals) grouped.push_back({a.texel, group, a.light});
}

std::uint32_t group_of(const Particle& particle) {
  return particle.group;
}
std::uint32_t group_of(const PolishedSuns::Start& start) {
  return start.particle.group;
}

// Traces one particle from its lamp.
class LampWalk {
 public:
  LampWalk(const Texels& texels, const CacheQuery& query, Sampler& sampler, std::vector<Arrival>& arrivals)
      : texels_(texels), query_(query), t_(query.transport()), sampler_(sampler), arrivals_(arrivals) {}

  // Returns the rays traced.
  std::uint64_t run(const Particle& particle) {
    ray_ = particle.ray, power_ = particle.power, punctual_ = particle.punctual;
    return go_on();
  }
  // The same for a particle that must be reflected by `triangle` first.
  std::uint64_t run(const PolishedSuns::Start& start) {
    reflected_by_ = start.triangle;
    return run(start.particle);
  }

 private:
  std::uint64_t go_on() {
    std::uint64_t rays = 0;
    int passes = 0;
    while (max_component(power_) > 0 && passes < kMaxPasses) {
      const Hit hit = t_.accel.intersect(ray_);
      ++rays;
      if (!hit || (leaves_ != kNoTexel && query_.continues_path(hit.distance, leaves_))) break;
      leaves_ = kNoTexel;
      const bool starts = bounces_ == 0 && reflected_by_ != kNoTriangle;
      if (starts && hit.triangle != reflected_by_) break;
      if (!starts && punctual_ && bounces_ == 0 && passes_glass(hit)) {
        ++passes;
        continue;
      }
      power_ *= medium_.passed(t_.accel.scene(), hit);
      if (bounces_ > 0 && !arrive(hit)) break;
      SurfacePoint surface = surface_at(t_.accel, hit, ray_.direction);
      const bool passes_by = surface.shade.coverage < 1 && sampler_.next1() >= surface.shade.coverage;
      if (starts && passes_by) break;
      if (!passes_by && (!surface.reflects || bounces_ >= t_.options.max_bounces)) break;
      const int before = bounces_;
      if (passes_by)
        ray_.origin = spawn_origin(surface, ray_.direction);
      else
        scatter(hit, surface);
      if (starts && bounces_ == before) break;
      passes = bounces_ > before ? 0 : passes + 1;
      if (bounces_ > before) rays += split();
    }
    return rays;
  }

  // Light of punctual lamps crosses solid glass straight, as shadow rays do. At a frosted front half of the particles
  // are reflected instead, since paths sample that reflection too.
  bool passes_glass(const Hit& hit) {
    const Scene& scene = t_.accel.scene();
    if (!scene.material_of(hit.triangle).solid) return false;
    const ShadePoint point = shade_point(scene, hit.triangle, hit.barycentric);
    if (!(point.eta > 0)) return false;
    if (hit.front && is_frosted(point)) {
      power_ *= 2;
      if (sampler_.next1() < 0.5f) return false;
    }
    power_ *= glass_.meet(point, hit.front, geometric_normal(scene, hit.triangle), ray_.direction, hit.distance);
    ray_.origin = spawn_origin(scene, hit.triangle, hit.barycentric, ray_.direction);
    return true;
  }

  // Splits a particle of large weight, as paths are split.
  std::uint64_t split() {
    const float weight = first_ > 0 ? max_component(power_) / first_ : 0;
    if (!(weight >= 2)) return 0;
    const int particles = static_cast<int>(std::min(weight, kMostParticles));
    power_ /= static_cast<float>(particles);
    std::uint64_t rays = 0;
    for (int k = 1; k < particles; ++k) rays += LampWalk(*this).go_on();
    return rays;
  }

  // Deposits light on the texel hit; true if the particle continues.
  bool arrive(const Hit& hit) {
    const std::uint32_t texel = hit.front ? texels_.find(hit.triangle, hit.barycentric) : kNoTexel;
    if (texel == kNoTexel) return true;
    const SurfacePoint on_texel = point_on_side(t_.accel, hit.triangle, hit.barycentric);
    const Vec3 from = -ray_.direction;
    const float cosine = glm::dot(on_texel.geometric_normal, from);
    // A point that a wall separates from its texel is outside the area of any texel.
    const bool own = !texels_.parts(hit.triangle, hit.barycentric);
    if (own && cosine > 0 && texels_.visible[texel] > 0 && texels_.area_m2[texel] > 0) {
      // Irradiance goes by the interpolated normal.
      const float tilt = Shading(on_texel, on_texel.normal).cosine(from) / cosine;
      const Vec3 light = power_ * (tilt / (texels_.area_m2[texel] * texels_.visible[texel]));
      const float incidence = std::max(glm::dot(texels_.sample_points[texel][0].normal, from), kLeastCosine);
      if (is_usable(light))
        arrivals_.push_back({texel, light, moments_of(luminance(light) / incidence, from)});
      else
        t_.accel.dropped().add(hit.triangle);
    }
    // Russian roulette before textures are read.
    const SceneMaterial& material = t_.accel.scene().material_of(hit.triangle);
    if (material.alpha_mode != AlphaMode::kOpaque || material.transmission > 0) return true;
    const float q = std::min(1.0f, kOften * (1 - texels_.diffuse_share[texel].at(cosine)));
    if (!(q > 0) || sampler_.next1() >= q) return false;
    power_ /= q;
    return true;
  }

  // Samples the next ray by all lobes but the diffuse one, with the weight of the adjoint path.
  void scatter(const Hit& hit, SurfacePoint& surface) {
    const Vec3 wi = -ray_.direction;
    const float diffuse_share = 1 - max_component(reflectance(surface.shade, glm::dot(surface.normal, wi)));
    const bool diffuse = surface.front && diffuse_share * max_component(surface.shade.diffuse) > 0;
    surface.shade.diffuse = Vec3(0);
    const Shading shading(surface, wi);
    const float u = sampler_.next1();
    const auto sample = shading.sample(u, sampler_.next2());
    const float cos_i = glm::dot(surface.geometric_normal, wi);
    if (!sample || !(cos_i > 0)) {
      power_ = Vec3(0);
      return;
    }
    const bool refracted = sample->lobe == Lobe::kRefraction;
    if (reflected_by_ != kNoTriangle && bounces_ == 0 && refracted) power_ = Vec3(0);
    if (is_frosted(surface.shade) && (refracted || surface.shade.inside)) power_ = Vec3(0);  // left to paths
    medium_.leave(surface.shade, refracted);
    if (sample->lobe == Lobe::kTransmission) {
      power_ *= sample->weight;
      // Light spread by a frosted pane is left to light sampling.
      if (punctual_ && bounces_ == 0 && t_.lights.frosted().spreads(hit.triangle)) power_ = Vec3(0);
    } else {
      const Vec3 wo = shading.world(*sample);
      power_ *= refracted || surface.shade.inside
                    ? sample->weight / sample->radiance_scale
                    : weight(hit, *sample, shading, wi, wo) * (glm::dot(surface.geometric_normal, wo) / cos_i);
      if (bounces_++ == 0) {
        first_ = max_component(power_);
        if (punctual_ && sample->delta) power_ = Vec3(0);
      } else {
        survive();
      }
      ray_.direction = wo;
      if (refracted ? is_left_diffuse(surface) : diffuse) leaves_ = texels_.find(surface.triangle, surface.barycentric);
    }
    ray_.origin = spawn_origin(surface, ray_.direction);
    if (is_usable(power_)) return;
    t_.accel.dropped().add(surface.triangle);
    power_ = Vec3(0);
  }

  // True if the outside of the glass that the particle leaves has a diffuse lobe.
  bool is_left_diffuse(const SurfacePoint& surface) const {
    return !surface.front &&
           max_component(shade_point(t_.accel.scene(), surface.triangle, surface.barycentric).diffuse) > 0;
  }

  Vec3 weight(const Hit& hit, const BsdfSample& sample, const Shading& chosen, const Vec3& wi, const Vec3& wo) const {
    if (sample.delta) return sample.weight;
    SurfacePoint seen = surface_at(t_.accel, hit, -wo);
    seen.shade.diffuse = Vec3(0);
    const float pdf = chosen.pdf(wo);
    return pdf > 0 ? Shading(seen, wo).eval(wi) / pdf : Vec3(0);
  }

  // Russian roulette. The first reflection is exempt: all arrivals are faint, and alike.
  void survive() {
    const float q = first_ > 0 ? std::min(1.0f, max_component(power_) / first_) : 0;
    power_ = q > 0 && sampler_.next1() < q ? power_ / q : Vec3(0);
  }

  const Texels& texels_;
  const CacheQuery& query_;
  const Transport& t_;
  Sampler& sampler_;
  std::vector<Arrival>& arrivals_;
  Ray ray_;
  Vec3 power_{0};
  float first_ = 0;  // after the first reflection
  bool punctual_ = false;
  std::uint32_t reflected_by_ = kNoTriangle;  // first
  Medium medium_;
  StraightGlass glass_;
  int bounces_ = 0;
  std::uint32_t leaves_ = kNoTexel;  // of the diffuse surface that the particle just left
};

}  // namespace

Status trace_lamps(const Texels& texels, const CacheQuery& query, std::uint64_t per_half, const Stage& stage,
                   LampLight& light) {
  const Context& context = stage.context;
  const Transport& t = query.transport();
  const Sources sources(t.accel.scene(), t.lights);
  const bool near = std::ranges::find(sources.kinds(), SourceKind::kNear) != sources.kinds().end();
  if (!light.suns) {
    std::uint64_t calibration_rays = 0;
    light.suns =
        std::make_shared<const PolishedSuns>(t.accel, t.lights, context.seed + seeds::kPolished, calibration_rays);
    stage.count(calibration_rays);
  }
  const PolishedSuns& suns = *light.suns;
  if (!near && suns.empty()) return {};
  while (light.particles < per_half) {
    const std::uint64_t first = light.particles, count = std::min(per_half - first, kUnit * (kUnits / kHalves));
    const std::size_t units = (count + kUnit - 1) / kUnit;  // of each half
    std::vector<std::vector<Arrival>> arrivals(units * kHalves);
    std::vector<std::vector<GroupedArrival>> grouped(units * kHalves);
    UnitLoop loop{.stage = "lamp paths", .count = arrivals.size(), .rays = 4.0 * kUnit};
    loop.inputs = [&](std::size_t u, Archive& key) { key(first, count, u, texels.eyes); };
    loop.compute = [&](std::size_t u) {
      std::uint64_t traced = 0;
      const std::uint64_t from = first + u / kHalves * kUnit, to = std::min(first + count, from + kUnit);
      for (std::uint64_t k = from; k < to && !context.stopped(); ++k) {
        const auto follow = [&](std::uint64_t seed, const auto& emit) {
          Sampler sampler(context.seed + seed, u % kHalves, static_cast<std::uint32_t>(k));
          const auto particle = emit(sampler);
          const std::size_t before = arrivals[u].size();
          traced += LampWalk(texels, query, sampler, arrivals[u]).run(particle);
          if (!light.grouped[0].empty())
            add_group_arrivals(std::span(arrivals[u]).subspan(before), group_of(particle), grouped[u]);
        };
        if (near) follow(seeds::kLampPaths, [&](Sampler& s) { return sources.emit(SourceKind::kNear, s); });
        if (!suns.empty()) follow(seeds::kPolished + 1, [&](Sampler& s) { return suns.emit(s, traced); });
      }
      add_up(arrivals[u]);
      return traced;
    };
    loop.results = [&](std::size_t u, Archive& archive) {
      archive(arrivals[u]);
      if (!light.grouped[0].empty()) archive(grouped[u]);
    };
    ORIEL_TRY_VOID(parallel_units(stage, loop));
    for (std::size_t u = 0; u < grouped.size(); ++u)
      for (const GroupedArrival& a : grouped[u]) light.grouped[u % kHalves].of(a.texel)[a.group] += a.light;
    for (std::size_t u = 0; u < arrivals.size(); ++u)
      for (const Arrival& a : arrivals[u]) {
        light.sum[u % kHalves][a.texel] += a.light;
        if (!light.moments.empty()) light.moments[a.texel] += a.moments;
      }
    light.particles += count;
  }
  return {};
}

}  // namespace oriel
