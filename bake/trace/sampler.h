// Random numbers as a function of (seed, stream, sample, dimension): never of a thread.
#pragma once

#include <array>

#include "formats/core/vec.h"

namespace oriel {

// A stateless mix of 64 bits (the finaliser of SplitMix64, Steele et al. 2014).
std::uint64_t mix64(std::uint64_t x);

// Owen-scrambled Sobol points in [0,1). Pairs of dimensions are (0,2)-sequences, each pair scrambled and shuffled on
// its own (Burley 2020, "Practical Hash-based Owen Scrambling"): padding, so any number of dimensions. Best used with a
// power of two of samples from index 0.
class Sampler {
 public:
  // stream: a texel, a pixel, …; sample: its index in the stream.
  Sampler(std::uint64_t seed, std::uint64_t stream, std::uint32_t sample);

  float next1();
  Vec2 next2();  // the next two dimensions, stratified together

 private:
  std::uint32_t shuffled_index(std::uint64_t hash) const;

  std::uint64_t key_;
  std::uint32_t reversed_sample_;
  std::uint32_t dimension_ = 0;
};

}  // namespace oriel
