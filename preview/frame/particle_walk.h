// A particle on its way through a scene: by reflection, glass and cut-outs until it ends.
#pragma once

#include <optional>

#include "bake/trace/path.h"
#include "bake/trace/shading.h"

namespace oriel {

class ParticleWalk {
 public:
  // power: of the particle, in any unit; sampler: must outlive it.
  ParticleWalk(const Transport& transport, const Ray& ray, const Vec3& power, Sampler& sampler)
      : transport_(transport), ray_(ray), power_(power), full_(max_component(power)), sampler_(sampler) {}

  // lands(surface, ray, power): it comes to a surface that reflects, as often as it does; leaves(ray): it meets nothing
  // any more. Ends after so many reflections, or by chance (from the second on).
  template <typename Lands, typename Leaves>
  void run(int most_bounces, const Lands& lands, const Leaves& leaves) {
    if (!(full_ > 0)) return;
    for (int bounces = 0, passes = 0; bounces < most_bounces && passes < kMaxPasses;) {
      const Hit hit = transport_.accel.intersect(ray_);
      if (!hit) return leaves(ray_);
      const SurfacePoint s = surface_at(transport_.accel, hit, ray_.direction);
      if (s.shade.coverage < 1 && sampler_.next1() >= s.shade.coverage) {
        ray_.origin = spawn_origin(s, ray_.direction), ++passes;
        continue;
      }
      if (!s.reflects) return;
      lands(s, ray_, power_);
      const auto straight = scatter(s);
      if (!straight || !is_usable(power_)) return;
      if (*straight)
        ++passes;
      else if (++bounces >= kRouletteFrom && !survive())
        return;
    }
  }

 private:
  static constexpr int kRouletteFrom = 2;

  // Nothing where the light ends, else whether it went straight on.
  std::optional<bool> scatter(const SurfacePoint& s) {
    const Shading shading(s, -ray_.direction);
    const float u = sampler_.next1();
    const auto sample = shading.sample(u, sampler_.next2());
    if (!sample || !(max_component(sample->weight) > 0)) return std::nullopt;
    power_ *= sample->weight / sample->radiance_scale;
    const bool straight = sample->lobe == Lobe::kTransmission;
    if (!straight) ray_.direction = shading.world(*sample);
    ray_.origin = spawn_origin(s, ray_.direction);
    return straight;
  }

  bool survive() {
    const float q = std::min(0.95f, max_component(power_) / full_);
    if (sampler_.next1() >= q) return false;
    power_ /= q;
    return true;
  }

  const Transport& transport_;
  Ray ray_;
  Vec3 power_;
  const float full_;
  Sampler& sampler_;
};

}  // namespace oriel
