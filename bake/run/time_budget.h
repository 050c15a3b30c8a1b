// How a bake shares out the wall clock that it may take: --time.
#pragma once

#include <algorithm>
#include <limits>

#include "bake/run/stopwatch.h"

namespace oriel {

// Seconds that parts of the bake may take; infinite where there is no limit. Runs from when it is made.
class TimeBudget : public ElapsedTime {
 public:
  // seconds: 0 for no limit.
  explicit TimeBudget(double seconds) : whole_(seconds) {}

  bool limited() const { return whole_ > 0; }
  // Seconds, negative once it is over; infinite where there is no limit.
  double left() const { return limited() ? whole_ - spent() : std::numeric_limits<double>::infinity(); }

  // Charts that are more than plain: some even where the scene alone took too long.
  double for_atlas() const { return kAtlas * std::max(left(), kLate * whole_); }
  double for_views() const { return kViews * left(); }  // choosing viewpoints
  double for_visible_sets() const { return kSets * left(); }
  // Finding reflectors; movers' own shadows; finding out how long capture takes.
  double for_each_other() const { return kOther * left(); }
  double for_maps() const { return kMaps * left(); }
  double for_light_field() const { return kField * std::max(0.0, left()); }
  // Until a pack of so many bytes of images is written.
  static double writing(double bytes) { return bytes / kWritten_per_s; }
  // What to keep for work that was foretold to take so long.
  static double kept_for(double foretold) { return kUnforeseen * foretold; }
  bool missed() const { return limited() && spent() > whole_ + kLate_s + kLate * whole_; }

 private:
  static constexpr double kAtlas = 0.2, kViews = 0.15, kSets = 0.2, kOther = 0.1;  // of the time that is left
  static constexpr double kMaps = 0.5, kField = 0.2;  // of what is left when the lightmap begins
  static constexpr double kUnforeseen = 1.3;          // times longer than foretold
  static constexpr double kWritten_per_s = 25e6;      // bytes of maps and lightmaps
  static constexpr double kLate_s = 1, kLate = 0.1;   // by which the whole may be missed, together
  double whole_;
};

}  // namespace oriel
