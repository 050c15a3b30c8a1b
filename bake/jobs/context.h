// What a stage may know of its surroundings: threads, progress, stop, seed, warnings. No file, clock or terminal.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "formats/core/result.h"

namespace oriel {

struct Progress {
  std::string_view stage;  // "radiosity", …
  double fraction = 0;     // [0,1] of this stage, monotonic
  std::uint64_t rays = 0;  // traced by this stage so far
};

// Shared by all stages of one bake. Every member function may be called from any thread.
class Context {
 public:
  int threads = 0;                                // 0: all that the machine has
  std::uint64_t seed = 1;                         // of every random number
  std::function<void(const Progress&)> progress;  // called from one thread at a time; may be empty
  std::function<void(const std::string&)> warn;   // a finding the user should read; may be empty
  std::atomic<bool> stop{false};  // set from outside (a signal handler may): stages return kStopped soon

  bool stopped() const { return stop.load(std::memory_order_relaxed); }
  void warning(const std::string& message);
  void report(std::string_view stage, double fraction, std::uint64_t rays = 0);

 private:
  std::mutex mutex_;
};

}  // namespace oriel
