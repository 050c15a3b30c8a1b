// What frames cost, for people and as JSON; and how much a sequence of them flickers.
#pragma once

#include <string>
#include <vector>

#include "formats/core/result.h"
#include "player/session/arguments.h"

namespace oriel {

struct FrameRecord {
  std::string camera;
  double ms = 0;  // of the whole frame
  FrameStats stats;
  bool in_zone = true;  // the eye is where reflections were planned for
  double live_s = 0;    // that the light of lamps took which had moved before the frame
};

// One line of counts, of the passes' times where they were taken, and a warning outside the zone.
std::string describe(const FrameStats& stats, bool in_zone);

// The record whose time is the median, with passes' times that are medians too: the first frame's uploads do not count.
FrameRecord median_record(const std::vector<FrameRecord>& records);

// How unevenly a sequence changes: |L(t-1) - 2 L(t) + L(t+1)| of L = log2(luminance + 1 % of the frame's mean), mean
// over the pixels. A steady move of smooth things has little of it, a pop has much in one frame. 1 is a factor of two.
class FlickerMeter {
 public:
  // light: RGB, the same size each time.
  void add(const std::vector<float>& light);
  double mean() const { return frames_ > 0 ? sum_ / frames_ : 0; }
  double worst() const { return worst_; }
  int worst_frame() const { return worst_frame_; }  // from 0

 private:
  std::vector<float> last_, before_last_;
  int added_ = 0, frames_ = 0, worst_frame_ = 0;
  double sum_ = 0, worst_ = 0;
};

// flicker: of a path, else null.
Status write_stats(const std::string& file, const PlayArguments& arguments, const std::string& renderer,
                   const std::vector<FrameRecord>& records, const FlickerMeter* flicker);

}  // namespace oriel
