// A progress estimate of refinement. It assumes that the squared error falls as a power of the work.
#pragma once

#include <algorithm>
#include <cmath>

namespace oriel {

class ProgressEstimate {
 public:
  // goal: squared error. before: work of the first estimate. most: limit on the work of refinement, may be infinite.
  ProgressEstimate(double goal, double before, double most)
      : goal_(goal), before_(std::max(before, 1.0)), most_(most) {}

  // The fraction done, [0,1]. work: of the refinement so far. error: squared error now.
  double fraction(double work, double error) {
    if (first_ < 0) first_ = error;
    if (!(error > goal_)) return 1;
    const double all = before_ + work, grown = std::log(all / before_);
    const double power = grown > kMeasurable ? std::clamp(std::log(first_ / error) / grown, kSlowest, kFastest) : 1;
    const double by_error = all * std::expm1(std::min(std::log(error / goal_) / power, kFar));
    const double rest = std::min(by_error, std::max(most_ - work, 0.0));
    return work / std::max(work + rest, 1e-300);
  }

 private:
  static constexpr double kMeasurable = 0.05, kSlowest = 0.3, kFastest = 4, kFar = 20;
  double goal_, before_, most_, first_ = -1;
};

}  // namespace oriel
