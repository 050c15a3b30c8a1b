#include "player/images/loading_watch.h"

#include <fmt/format.h>

#include <algorithm>

namespace oriel {

void LoadingWatch::frame(Clock::time_point now, bool busy) {
  if (all_s_ > 0) return;
  const double since_start_s = std::chrono::duration<double>(now - started_).count();
  if (frames_ == 0)
    first_s_ = since_start_s;
  else
    longest_ms_ = std::max(longest_ms_, std::chrono::duration<double, std::milli>(now - last_).count());
  last_ = now;
  ++frames_;
  if (!busy) all_s_ = since_start_s;
}

std::optional<std::string> LoadingWatch::news() {
  if (all_s_ == 0 || told_) return std::nullopt;
  told_ = true;
  return fmt::format("first frame after {:.2f} s, all images after {:.2f} s in {} frames, the longest of {:.0f} ms",
                     first_s_, all_s_, frames_, longest_ms_);
}

}  // namespace oriel
