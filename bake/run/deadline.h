// The wall clock that a bake may take: --time.
#pragma once

#include <chrono>
#include <limits>

namespace oriel {

// Runs from when it is made.
class Deadline {
 public:
  // seconds: 0 for no limit.
  explicit Deadline(double seconds) : seconds_(seconds), start_(Clock::now()) {}

  bool limited() const { return seconds_ > 0; }
  double spent() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  // Seconds, negative once it is over; infinite where there is no limit.
  double left() const { return limited() ? seconds_ - spent() : std::numeric_limits<double>::infinity(); }

 private:
  using Clock = std::chrono::steady_clock;
  double seconds_;
  Clock::time_point start_;
};

}  // namespace oriel
