// The suns' light where polished surfaces throw it on.
#pragma once

#include <vector>

#include "bake/trace/emission.h"
#include "bake/trace/lights.h"

namespace oriel {

// Particles from directional lights that start where these meet polished surfaces (is_polished): of those that start
// through a disk as large as the scene few would come into a room. Each triangle is chosen by what it gets of a sun and
// reflects, as a few shadow rays tell; where none of them finds the sun a little is left, so that the mean stays right.
// Holds references. Immutable.
class PolishedSuns {
 public:
  struct Start {
    Particle particle;  // its first surface is `triangle`, or nothing
    std::uint32_t triangle = 0;
  };

  // Adds to `rays`.
  PolishedSuns(const Accel& accel, const LightSet& lights, std::uint64_t seed, std::uint64_t& rays);

  bool empty() const { return targets_.empty(); }
  // Power 0 where something hides the sun there. A mean over many is all of such light.
  Start emit(Sampler& sampler, std::uint64_t& rays) const;

 private:
  struct Target {
    std::uint32_t triangle = 0, light = 0;  // into Scene::lights
  };
  Start start_on(const Target& target, Sampler& sampler, std::uint64_t& rays) const;

  const Accel& accel_;
  const LightSet& lights_;
  std::vector<Target> targets_;
  std::vector<double> cdf_;  // cumulative, of what they reflect, lm
};

}  // namespace oriel
