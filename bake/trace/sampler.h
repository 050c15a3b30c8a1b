// Random numbers as a function of (seed, stream, sample, dimension): never of a thread.
#pragma once

#include <vector>

#include "formats/core/vec.h"

namespace oriel {

// A stateless mix of 64 bits (the finaliser of SplitMix64, Steele et al. 2014).
std::uint64_t mix64(std::uint64_t x);

// Whose random numbers. stream: a texel, a pixel, …; sample: its index in the stream.
struct SampleId {
  std::uint64_t seed = 0, stream = 0;
  std::uint32_t sample = 0;
};

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

// One Owen-scrambled Sobol sequence that many streams share, each with digits flipped by its own random shift (Cranley
// & Patterson's rotation in base 2): nets stay nets, and points cost an exclusive or. For millions of short streams.
class ShiftedNet {
 public:
  ShiftedNet(std::uint64_t seed, std::uint32_t count);

  UVec2 shift(std::uint64_t stream) const;
  // sample: below the count.
  Vec2 point(std::uint32_t sample, const UVec2& shift) const {
    const UVec2 bits = digits_[sample] ^ shift;
    return Vec2(bits >> 8u) * 0x1p-24f;
  }

 private:
  std::uint64_t seed_;
  std::vector<UVec2> digits_;
};

}  // namespace oriel
