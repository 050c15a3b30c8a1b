// Samples of light that are no numbers are kept out where they arise: one of them would spread over whole surfaces.
#pragma once

#include <atomic>
#include <cmath>
#include <cstdint>

#include "formats/core/vec.h"

namespace oriel {

// Light beyond this, in whatever unit, is a mistake of arithmetic; its square is still a float.
inline constexpr float kAbsurdLight = 1e15f;

// Finite and not absurd. False for NaN, too.
inline bool is_usable(const Vec3& light) {
  return std::abs(light.x) <= kAbsurdLight && std::abs(light.y) <= kAbsurdLight && std::abs(light.z) <= kAbsurdLight;
}

// How many samples were left out, and one place to look for the cause. Any thread may add.
class DroppedSamples {
 public:
  static constexpr std::uint32_t kNowhere = ~0u;  // Hit's, of a ray that met nothing

  // triangle: where the sample was taken or met a surface; kNowhere: unknown.
  void add(std::uint32_t triangle) {
    count_.fetch_add(1, std::memory_order_relaxed);
    std::uint32_t first = first_.load();
    while (triangle < first && !first_.compare_exchange_weak(first, triangle)) {
    }
  }
  std::uint64_t count() const { return count_; }
  std::uint32_t first_triangle() const { return first_; }  // the lowest, whatever the order; kNowhere: none is known

 private:
  std::atomic<std::uint64_t> count_{0};
  std::atomic<std::uint32_t> first_{kNowhere};
};

}  // namespace oriel
