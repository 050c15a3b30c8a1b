// How a window's first seconds went.
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace oriel {

class LoadingWatch {
 public:
  using Clock = std::chrono::steady_clock;
  // started: when the user asked for the pack.
  explicit LoadingWatch(Clock::time_point started) : started_(started) {}

  // A frame was shown `now`; busy: images were still to come.
  void frame(Clock::time_point now, bool busy);
  // Once, when all images were there for the first time: what it took.
  std::optional<std::string> news();

 private:
  Clock::time_point started_, last_;
  double first_s_ = 0, all_s_ = 0, longest_ms_ = 0;  // all_s_ 0: not yet; longest_ms_: from one frame to the next
  int frames_ = 0;
  bool told_ = false;
};

}  // namespace oriel
