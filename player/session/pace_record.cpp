#include "player/session/pace_record.h"

#include <algorithm>
#include <numeric>

#include "formats/core/json.h"

namespace oriel {
namespace {

float quantile(std::vector<float> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1, static_cast<std::size_t>(share * static_cast<double>(values.size())))];
}

}  // namespace

void PaceRecord::add(Pace::Draw drawn, float scale, double taken_s, double still_s, double now_s) {
  // Between two of a motion all counts, what is no drawing too.
  const bool goes_on = drawn == Pace::Draw::kCoarse && last_ == drawn;
  const auto ms = static_cast<float>(1e3 * (goes_on ? now_s - last_s_ : taken_s));
  if (drawn == Pace::Draw::kCoarse) moving_ms_.push_back(ms), scales_ += scale;
  if (drawn == Pace::Draw::kWhole) {
    whole_ms_.push_back(ms);
    if (last_ == Pace::Draw::kCoarse) slowest_rest_s_ = std::max(slowest_rest_s_, still_s);
  }
  if (drawn != Pace::Draw::kKeep) last_ = drawn, last_s_ = now_s;
}

float PaceRecord::frames_per_s() const {
  const float sum = std::accumulate(moving_ms_.begin(), moving_ms_.end(), 0.0f);
  return sum > 0 ? 1e3f * static_cast<float>(moving_ms_.size()) / sum : 0;
}

std::string PaceRecord::json() const {
  const auto n = static_cast<double>(std::max<std::size_t>(moving_ms_.size(), 1));
  const Json out = {{"moving",
                     {{"frames", moving_ms_.size()},
                      {"frames_per_s", frames_per_s()},
                      {"median_ms", quantile(moving_ms_, 0.5)},
                      {"slowest_tenth_ms", quantile(moving_ms_, 0.9)},
                      {"slowest_ms", quantile(moving_ms_, 1)},
                      {"mean_scale", scales_ / n}}},
                    {"whole",
                     {{"frames", whole_ms_.size()},
                      {"slowest_ms", quantile(whole_ms_, 1)},
                      {"slowest_after_motion_s", slowest_rest_s_}}}};
  return out.dump(1) + "\n";
}

}  // namespace oriel
