// How much of a refinement is done: its squared error falls as a power of the work, until a goal or an end of rays.
#pragma once

#include <algorithm>
#include <cmath>

namespace oriel {

class WorkLeft {
 public:
  // goal: squared error. before: work that the first estimate took; most: of refinement, may be infinite.
  WorkLeft(double goal, double before, double most) : goal_(goal), before_(std::max(before, 1.0)), most_(most) {}

  // Share of the refinement that is done: so much work of it, which has left that squared error.
  double done(double work, double error) {
    if (first_ < 0) first_ = error;
    if (!(error > goal_)) return 1;
    const double all = before_ + work, grown = std::log(all / before_);
    const double power = grown > kTells ? std::clamp(std::log(first_ / error) / grown, kSlowest, kFastest) : 1;
    const double by_error = all * std::expm1(std::min(std::log(error / goal_) / power, kFar));
    const double left = std::min(by_error, std::max(most_ - work, 0.0));
    return work / std::max(work + left, 1e-300);
  }

 private:
  static constexpr double kTells = 0.05, kSlowest = 0.3, kFastest = 4, kFar = 20;
  double goal_, before_, most_, first_ = -1;
};

}  // namespace oriel
