#include "player/session/pace.h"

#include <algorithm>

namespace oriel {
namespace {

constexpr float kAim = 0.85f;  // of the slowest frame: views along a walk differ
constexpr float kRoom = 0.6f;  // of it, below which whole frames will do
constexpr int kSteady = 12;    // frames before they do, and at most after finer ones were too slow
constexpr int kMostSteady = 600;
constexpr float kLessWork = 0.7f;  // a coarse frame of the whole one's size, beside that
constexpr int kSlowLevel = 4;
constexpr double kPatience = 0.25, kLongestStill_s = 0.4;  // of the last whole frame's time

}  // namespace

Pace::Pace(bool slow_device, const PaceOptions& options)
    : options_(options), level_(slow_device ? kSlowLevel : 0), steady_(kSteady) {}

Pace::Draw Pace::next(bool moved, bool altered, Quality quality, double now_s) {
  if (moved) moved_s_ = now_s;
  const bool coarse_only = quality == Quality::kFast;
  const bool may_coarsen = coarse_only || (quality == Quality::kAutomatic && level_ > 0);
  // A whole frame that takes long holds the next step up: it waits for a longer rest.
  const double still_s = std::clamp(1e-3 * kPatience * whole_ms_, options_.still_s, kLongestStill_s);
  const bool stands = now_s - moved_s_ >= still_s;
  Draw draw = Draw::kKeep;
  if (!may_coarsen) {
    if (moved || altered || !shows_whole_) draw = Draw::kWhole;
  } else if (moved || !drawn_ || (altered && (coarse_only || !stands))) {
    draw = Draw::kCoarse;
  } else if (!coarse_only && stands && (altered || !shows_whole_)) {
    draw = Draw::kWhole;
  }
  if (coarse_only && level_ == 0) level_ = 1;
  if (draw != Draw::kKeep) shows_whole_ = draw == Draw::kWhole, drawn_ = true;
  return draw;
}

// The finest level that the time of a frame at this one leaves room for.
void Pace::fit(float ms) {
  const float aim = kAim * options_.slowest_ms;
  const float whole = level_ > 0 ? ms / work(level_) : kLessWork * ms;
  int level = std::max(level_, 1);
  while (level < kLevels && whole * work(level) > aim) ++level;
  level_ = level;
  frames_ = 0;
  mean_ms_ = 0;
  tries_ = false;
}

void Pace::took(Draw drawn, float ms) {
  if (drawn == Draw::kKeep || !(ms >= 0)) return;
  if (drawn == Draw::kWhole) {
    const bool first = whole_ms_ == 0;  // which made its textures too
    whole_ms_ = ms;
    if (level_ == 0 && !first && ms > options_.slowest_ms) fit(ms);
    if (level_ > 0 && ms < kRoom * options_.slowest_ms) level_ = 0;
    return;
  }
  ++frames_;
  mean_ms_ = mean_ms_ == 0 ? ms : mean_ms_ + (ms - mean_ms_) / 4;
  if (frames_ > 2 && mean_ms_ > options_.slowest_ms * 0.95f) {
    // What a frame shows does not say what a finer one would: each try that failed makes the next one later.
    if (tries_ && frames_ < kSteady) steady_ = std::min(4 * steady_, kMostSteady), failed_ = level_;
    return fit(mean_ms_);
  }
  if (frames_ < kSteady) return;
  if (tries_ && level_ <= failed_) steady_ = kSteady;
  tries_ = false;
  if (level_ > 1 && frames_ >= (level_ - 1 <= failed_ ? steady_ : kSteady)) go_finer();
}

void Pace::go_finer() {
  if (mean_ms_ * work(level_ - 1) / work(level_) > kAim * options_.slowest_ms) return;
  --level_;
  frames_ = 0;
  mean_ms_ = 0;
  tries_ = true;
}

}  // namespace oriel
