// The first direct light of all texels, and the time that it may take.
#pragma once

#include "bake/radiosity/estimators/direct_light.h"
#include "bake/radiosity/estimators/estimator.h"

namespace oriel {

// That finding the texels' points may take; infinite where there is no limit.
double points_seconds(const RadiosityTask& task);

class FirstDirect {
 public:
  static constexpr std::uint32_t kSamples = 2;  // a half, texel and light, before any refinement
  static constexpr double kTime = 0.3;          // of the time left, for the first samples and again for more

  // The references must outlive this.
  FirstDirect(const RadiosityTask& task, const DirectLight& light, Texels& texels, DirectSums& sums)
      : task_(task), light_(light), texels_(texels), sums_(sums) {}

  // Takes a few samples of each of the texels. Those that get none for want of time are left out: false then.
  Result<bool> everywhere(const std::vector<std::uint32_t>& texels);
  double seconds() const { return seconds_; }  // that it took
  std::uint32_t samples() const;               // that it took

  // False where it ended by enough().
  Result<bool> estimate(const std::vector<std::uint32_t>& list, std::uint32_t per_half,
                        const std::function<bool()>& enough) const;
  // True once kTime of what is left now is over; empty where there is no limit.
  std::function<bool()> time_is_over() const;

 private:
  const RadiosityTask& task_;
  const DirectLight& light_;
  Texels& texels_;
  DirectSums& sums_;
  double seconds_ = 0;
};

}  // namespace oriel
