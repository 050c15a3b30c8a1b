// How many samples each lamp of a group of texels gets, by what a few of each tell.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "bake/radiosity/texels/texels.h"

namespace oriel {

// Of a light and texel, by half: Σ unoccluded irradiance, Σ weights, Σ weights * transmittance.
struct LightTally {
  std::array<Vec3, kHalves> open{}, weight{}, passed{};
  Vec4 from{0};  // Σ moments of weights * transmittance, by luminance
};

// What the first samples of a light tell of it.
struct LightPilot {
  static constexpr std::uint32_t kSamples = 2;  // a half, at most

  std::vector<LightTally> tallies;  // by texel
  bool all = true, none = true;     // of the texels see it, wholly
  float noise = 0;                  // of all texels' light, were it known from one sample, lux²; 0: all or none see it
};

// Samples a half, of at most per_half. Where the first samples of all texels of the group see the light, or none of
// them does, it is left at that: the others would tell the same. A hall of many lamps has few in whose penumbra a place
// lies. Of these faint ones have fewer: of n samples the variance falls as n^-1.5 (stratified points, an edge between
// lit and dark), so one more takes n^-2.5 off it. It shall take no less off than one more of the noisiest lamp, of
// which all noise is `most` (Neyman 1934).
inline std::uint32_t samples_of(const LightPilot& pilot, float most, std::uint32_t per_half) {
  constexpr float kGain = 2.5f;
  if (pilot.none) return std::min(per_half, LightPilot::kSamples);
  std::uint32_t samples = per_half;
  if (pilot.all) return samples;
  const auto has_enough = [&](std::uint32_t n) {
    return pilot.noise * std::pow(static_cast<float>(per_half) / static_cast<float>(n), kGain) <= most;
  };
  while (samples > 2 * LightPilot::kSamples && has_enough(samples / 2)) samples /= 2;
  return samples;
}

}  // namespace oriel
