// Allocation of samples to the lights of a group of texels, calibrated by a few samples of each.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "bake/radiosity/texels/texels.h"

namespace oriel {

// Sums of a ratio estimator for one light and texel, by half.
struct LightTally {
  std::array<Vec3, kHalves> unoccluded{}, proposal_weight{}, transmitted{};
  Vec4 transmitted_moments{0};  // Σ moments of `transmitted`, by luminance
};

// Statistics of a light's first samples.
struct LightCalibration {
  static constexpr std::uint32_t kSamples = 2;  // a half, at most

  std::vector<LightTally> tallies;               // by texel
  bool all_visible = true, all_occluded = true;  // from all texels
  float noise = 0;  // variance of the light by one sample, sum over texels, lux²; 0: none is occluded, or all
};

// The number of samples a half for a light, at most per_half. Where the first samples of all texels of the group see
// the light, or none does, no further ones are taken: a hall has many lamps, and a place lies in the penumbrae of few.
// Other lights get fewer samples if they are faint. The variance of n samples falls as n^-1.5 (stratified points, a
// visibility edge), so one more sample reduces it by n^-2.5. That reduction is made equal for all lights (Neyman
// allocation, 1934), `most` being the noise of the noisiest light.
inline std::uint32_t sample_count(const LightCalibration& calibration, float most, std::uint32_t per_half) {
  constexpr float kGain = 2.5f;
  if (calibration.all_occluded) return std::min(per_half, LightCalibration::kSamples);
  std::uint32_t samples = per_half;
  if (calibration.all_visible) return samples;
  const auto has_enough = [&](std::uint32_t n) {
    return calibration.noise * std::pow(static_cast<float>(per_half) / static_cast<float>(n), kGain) <= most;
  };
  while (samples > 2 * LightCalibration::kSamples && has_enough(samples / 2)) samples /= 2;
  return samples;
}

}  // namespace oriel
