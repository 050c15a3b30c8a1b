// What a session's frames took: how many came while something moved, and how soon the whole one after it.
#pragma once

#include <string>
#include <vector>

#include "player/session/pace.h"

namespace oriel {

class PaceRecord {
 public:
  // A frame is on the screen, now_s. taken_s: since its work began. still_s: since the last motion.
  void add(Pace::Draw drawn, float scale, double taken_s, double still_s, double now_s);
  bool empty() const { return moving_ms_.empty() && whole_ms_.empty(); }

  // Frames while moving: from one to the next, ms.
  float frames_per_s() const;
  // "moving": frames, frames_per_s, median_ms, slowest_tenth_ms, slowest_ms, mean_scale; "whole": frames, slowest_ms,
  // slowest_after_motion_s.
  std::string json() const;

 private:
  std::vector<float> moving_ms_, whole_ms_;
  double scales_ = 0, slowest_rest_s_ = 0, last_s_ = 0;
  Pace::Draw last_ = Pace::Draw::kKeep;
};

}  // namespace oriel
