// What each pass of a frame costs.
#pragma once

#include <array>
#include <chrono>
#include <vector>

#include "player/gpu/device.h"
#include "player/gpu/handle.h"
#include "player/scene/frame_options.h"

namespace oriel {

class PassClock {
 public:
  PassClock() = default;
  // With OpenGL's timers, or by waiting for each pass to end.
  explicit PassClock(bool timers) : queries_(timers) {}

  // The passes of a frame that begins now are timed, or not.
  void start(bool on);
  // Runs what draws as part of a pass.
  template <class Draw>
  decltype(auto) time(Pass pass, const Draw& draw) {
    const Interval interval(*this, pass);
    return draw();
  }
  // Milliseconds a pass since start(); waits for the device. Zeros where not timed.
  PassTimes read();

 private:
  struct Interval {
    Interval(PassClock& clock, Pass pass) : owner(clock) { owner.begin(pass); }
    ~Interval() { owner.end(); }
    PassClock& owner;
  };
  void begin(Pass pass);
  void end();

  bool queries_ = false, on_ = false;
  std::vector<gpu::Query> pool_;
  std::vector<Pass> timed_;  // by query of the pool
  PassTimes times_{};
  std::chrono::steady_clock::time_point began_;
};

}  // namespace oriel
