// The user's limit of time: the one clock that a stage may look at.
#pragma once

#include <atomic>
#include <chrono>

namespace oriel {

class AtlasTimeLimit {
 public:
  explicit AtlasTimeLimit(double seconds)  // 0: never
      : limited_(seconds > 0),
        end_(Clock::now() +
             std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(limited_ ? seconds : 0))) {}

  bool passed() const {
    if (!limited_) return false;
    if (!struck_.load(std::memory_order_relaxed) && Clock::now() >= end_) struck_ = true;
    return struck_.load(std::memory_order_relaxed);
  }
  // True once passed() has been: something was done differently.
  bool struck() const { return struck_; }

 private:
  using Clock = std::chrono::steady_clock;
  bool limited_;
  Clock::time_point end_;
  mutable std::atomic<bool> struck_{false};
};

}  // namespace oriel
