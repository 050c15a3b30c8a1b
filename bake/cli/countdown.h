// Time left as people are told it: it falls without jumps, and meets the estimate while that is still to come.
#pragma once

#include <algorithm>
#include <cmath>

namespace oriel {

class Countdown {
 public:
  // The estimate as it is now_s seconds after the start; what is told of it. It runs faster or slower than the clock by
  // the fourth power of what it is off by, at most kFastest times: told twice too much, half of that is gone after a
  // fifth of the time that is left. It rises only where it stays wrong by far: a bake that goes on for minutes does not
  // end in a second.
  double tell(double estimate_s, double now_s) {
    if (estimate_s <= kFarTimes * told_s_ + kFar_s) far_since_s_ = now_s;
    if (told_s_ < 0 || now_s - far_since_s_ >= kPatience_s) {
      told_s_ = std::max(estimate_s, 0.0);
    } else if (told_s_ > 0) {
      const double off = told_s_ / std::max(estimate_s, kLeast_s);
      const double pace = std::clamp(off * off * off * off, kSlowest, kFastest);
      const double slower = told_s_ - pace * (now_s - last_s_);
      told_s_ = std::max(slower, std::clamp(estimate_s, 0.0, told_s_));  // lines are far apart: not past it
      if (off < 1) told_s_ = std::max(slower, 0.0);
    }
    last_s_ = now_s;
    return told_s_;
  }
  bool begun() const { return told_s_ >= 0; }

 private:
  static constexpr double kLeast_s = 0.1, kSlowest = 0.05, kFastest = 16, kFarTimes = 2, kFar_s = 10, kPatience_s = 5;
  double told_s_ = -1, last_s_ = 0, far_since_s_ = 0;
};

}  // namespace oriel
