// Random numbers that are the same on every machine, unlike the standard library's distributions.
#pragma once

#include <cmath>
#include <cstdint>

#include "formats/core/vec.h"

namespace oriel::fuzz {

class Random {
 public:
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0) : state_(seed * 0x9e3779b97f4a7c15ull ^ ~stream) {}

  // Steele et al. 2014, "Fast Splittable Pseudorandom Number Generators" (SplitMix64).
  std::uint64_t bits() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15ull;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  }
  float unit() { return static_cast<float>(bits() >> 40) * 0x1p-24f; }  // [0, 1)
  float between(float low, float high) { return low + (high - low) * unit(); }
  // Even in the exponent: low and high > 0.
  double decades(double low, double high) { return low * std::pow(high / low, static_cast<double>(unit())); }
  int below(int n) { return static_cast<int>(bits() % static_cast<std::uint64_t>(n)); }
  int whole(int low, int high) { return low + below(high - low + 1); }  // both included
  bool chance(float p) { return unit() < p; }
  Vec3 in_box(const Vec3& low, const Vec3& high) {
    const float x = between(low.x, high.x), y = between(low.y, high.y), z = between(low.z, high.z);
    return {x, y, z};
  }

 private:
  std::uint64_t state_;
};

}  // namespace oriel::fuzz
