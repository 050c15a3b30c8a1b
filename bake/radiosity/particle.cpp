#include "bake/radiosity/particle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "bake/trace/glass.h"
#include "bake/trace/shading.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

// Gauss-Legendre over cos²θ: ∫ R cosθ dω / π = ∫ R d(cos²θ).
constexpr float kCos2[] = {0.06943184f, 0.33000948f, 0.66999052f, 0.93056816f};
constexpr float kWeight[] = {0.17392742f, 0.32607258f, 0.32607258f, 0.17392742f};

Hit hit_on_side(Hit hit, bool front) {
  hit.front = front;
  return hit;
}

double lumens(const Vec3& power) {
  return luminance(DVec3(power));
}

class ParticleTracer {
 public:
  ParticleTracer(const Transport& transport, const EvaluatedTexels& texels, const Particle& particle, Sampler& sampler,
                 std::uint64_t& rays)
      : t_(transport),
        texels_(texels),
        sampler_(sampler),
        rays_(rays),
        ray_(particle.ray),
        power_(particle.power),
        full_(max_component(particle.power)),
        sharp_(particle.punctual) {}

  Fate run(bool from_afar) {
    bool met = !from_afar;
    fate_.emitted = lumens(power_);
    if (!(full_ > 0)) return fate_;
    for (;;) {
      ++rays_;
      const Hit hit = t_.accel.intersect(ray_);
      if (!hit) break;
      const SurfacePoint surface = surface_at(t_.accel, hit, ray_.direction);
      absorb(hit);
      add_to_texel(surface);
      if (passes_ == kMaxPasses) return lose(fate_.lost_guard);
      if (surface.shade.coverage < 1 && sampler_.next1() >= surface.shade.coverage) {
        ray_.origin = spawn_origin(surface, ray_.direction);
        ++passes_;
        continue;
      }
      met = true;
      if (!surface.reflects) return lose(fate_.lost_behind);
      if (bounces_ >= t_.options.max_bounces) return lose(fate_.lost_guard);
      const double came = lumens(power_);
      scatter(hit, surface);
      fate_.absorbed += came - lumens(power_);
      if (!(max_component(power_) > 0) || !survive()) return fate_;
    }
    if (!met) return {};
    return lose(fate_.escaped);
  }

 private:
  // Absorbs light in the glass that the particle came through.
  void absorb(const Hit& hit) {
    const double came = lumens(power_);
    power_ *= medium_.passed(t_.accel.scene(), hit);
    fate_.absorbed += came - lumens(power_);
  }

  const Fate& lose(double& sink) {
    sink += lumens(power_);
    return fate_;
  }

  // Texels have irradiance by the interpolated normal, so the light is scaled by the cosines.
  void add_to_texel(const SurfacePoint& surface) {
    if (!surface.front || !texels_.contains(surface.triangle, surface.barycentric)) return;
    const SurfacePoint on_texel = point_on_side(t_.accel, surface.triangle, surface.barycentric);
    const Vec3 wi = -ray_.direction;
    const float cosine = glm::dot(on_texel.geometric_normal, wi);
    if (!(cosine > 0)) return;
    const float tilt = Shading(on_texel, on_texel.normal).cosine(wi) / cosine;
    fate_.on_texels += lumens(power_ * absorptance(surface.shade)) * tilt;
  }

  // Chooses the next ray; power_ becomes what goes on along it.
  void scatter(const Hit& hit, const SurfacePoint& surface) {
    const Vec3 wi = -ray_.direction;
    const Shading shading(surface, wi);
    const float u = sampler_.next1();
    const auto sample = shading.sample(u, sampler_.next2());
    const bool is_sharp = std::exchange(sharp_, false);
    const float cos_i = glm::dot(surface.geometric_normal, wi);
    if (!sample || !(cos_i > 0)) {
      power_ = Vec3(0);
      return;
    }
    if (sample->lobe == Lobe::kTransmission) {
      power_ *= sample->weight;
      ++passes_;
      if (is_sharp && t_.lights.frosted().spreads(hit.triangle)) {
        spread(hit, surface, shading);
      } else {
        sharp_ = is_sharp;
      }
    } else if (sample->lobe == Lobe::kRefraction) {
      power_ *= sample->weight / sample->radiance_scale;
      ray_.direction = shading.world(*sample);
      ++bounces_;
      passes_ = 0;
    } else {
      const Vec3 wo = shading.above(sample->wi);
      // Scattering by facets within glass conserves energy.
      const float turned = surface.shade.inside ? 1 : glm::dot(surface.geometric_normal, wo) / cos_i;
      power_ *= weight(hit, *sample, shading, wi, wo) * turned;
      ray_.direction = wo;
      ++bounces_;
      passes_ = 0;
    }
    medium_.leave(surface.shade, sample->lobe == Lobe::kRefraction);
    ray_.origin = spawn_origin(surface, ray_.direction);
    if (!is_usable(power_)) {
      t_.accel.dropped().add(surface.triangle);
      power_ = Vec3(0);
    }
  }

  // Scatters light at a frosted pane, with the weight of the adjoint path.
  void spread(const Hit& hit, const SurfacePoint& surface, const Shading& shading) {
    const Vec3 wi = -ray_.direction;
    ray_.direction = shading.spread(sampler_.next2());
    const SurfacePoint seen = surface_at(t_.accel, hit_on_side(hit, !hit.front), -ray_.direction);
    const float cos_o = std::abs(glm::dot(seen.normal, ray_.direction)), cos_i = glm::dot(surface.normal, wi);
    const float pdf = shading.spread_pdf(ray_.direction),
                transmitted = 1 - max_component(reflectance(surface.shade, cos_i));
    const float adjoint =
        Shading(seen, ray_.direction).spread_pdf(wi) * (1 - max_component(reflectance(seen.shade, cos_o)));
    power_ *= pdf > 0 && transmitted > 0 ? adjoint * cos_o / (pdf * transmitted * cos_i) : 0;
  }

  // f cosθi over the density of wo, f being that of the adjoint path.
  Vec3 weight(const Hit& hit, const BsdfSample& sample, const Shading& chosen, const Vec3& wi, const Vec3& wo) const {
    if (sample.delta) return sample.weight;
    const SurfacePoint seen = surface_at(t_.accel, hit, -wo);
    const float pdf = chosen.pdf(wo);
    return pdf > 0 ? Shading(seen, wo).eval(wi) / pdf : Vec3(0);
  }

  bool survive() {
    if (bounces_ < t_.options.roulette_from) return true;
    const float q = std::min(1.0f, max_component(power_) / full_);
    if (sampler_.next1() >= q) return false;
    power_ /= q;
    return true;
  }

  const Transport& t_;
  const EvaluatedTexels& texels_;
  Sampler& sampler_;
  std::uint64_t& rays_;
  Ray ray_;
  Vec3 power_;
  float full_;
  bool sharp_;  // from a punctual lamp or sun, not scattered so far
  Medium medium_;
  int bounces_ = 0, passes_ = 0;
  Fate fate_;
};

}  // namespace

Vec3 absorptance(const ShadePoint& point) {
  Vec3 leaves(0);
  for (int i = 0; i < 4; ++i) {
    const Vec3 r = reflectance(point, std::sqrt(kCos2[i]));
    leaves += kWeight[i] * (r + (point.diffuse + point.transmission) * (1 - max_component(r)));
  }
  return point.coverage * glm::max(Vec3(0), 1.0f - leaves);
}

bool EvaluatedTexels::contains(std::uint32_t triangle, const Vec2& b) const {
  const std::int32_t page = atlas.page[triangle];
  if (page < 0) return false;
  const auto number = static_cast<std::size_t>(page);
  const std::array<DVec2, 3> corners = texel_triangle(atlas, triangle);
  const DVec2 p = corners[0] + double{b.x} * (corners[1] - corners[0]) + double{b.y} * (corners[2] - corners[0]);
  const auto along = [](double x, std::uint32_t size) {
    return static_cast<std::size_t>(std::clamp(x, 0.0, size - 1.0));
  };
  return evaluated[number][along(p.y, map[number].height) * map[number].width + along(p.x, map[number].width)];
}

Fate follow(const Transport& transport, const EvaluatedTexels& texels, const Particle& particle, Sampler& sampler,
            std::uint64_t& rays) {
  return ParticleTracer(transport, texels, particle, sampler, rays).run(particle.from_afar);
}

}  // namespace oriel
