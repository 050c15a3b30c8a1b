// Emission of particles from suns at the polished surfaces that they light.
#pragma once

#include <vector>

#include "bake/trace/emission.h"
#include "bake/trace/lights.h"

namespace oriel {

// Particles from directional lights that start where the light hits polished surfaces (is_polished). Started on a disk
// as large as the scene, few would enter a room. A triangle is chosen in proportion to the unoccluded flux that it gets
// and reflects, times its visibility to the sun as measured by a few shadow rays. The visibility is clamped to a small
// minimum, which keeps the estimate unbiased. Holds references. Immutable.
class PolishedSuns {
 public:
  struct Start {
    Particle particle;  // its first surface is `triangle`, or nothing
    std::uint32_t triangle = 0;
  };

  // Traces the shadow rays, and adds their number to `rays`.
  PolishedSuns(const Accel& accel, const LightSet& lights, std::uint64_t seed, std::uint64_t& rays);

  bool empty() const { return targets_.empty(); }
  // Emits one particle; power in lm, 0 if the sun is occluded there. The mean over many is all of such light.
  Start emit(Sampler& sampler, std::uint64_t& rays) const;

 private:
  struct Target {
    std::uint32_t triangle = 0, light = 0;  // into Scene::lights
  };
  Start start_on(const Target& target, Sampler& sampler, std::uint64_t& rays) const;

  const Accel& accel_;
  const LightSet& lights_;
  std::vector<Target> targets_;
  std::vector<double> cdf_;  // cumulative reflected flux, lm
};

}  // namespace oriel
