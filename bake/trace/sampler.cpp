#include "bake/trace/sampler.h"

namespace oriel {
namespace {

std::uint32_t reverse_bits(std::uint32_t x) {
  x = __builtin_bswap32(x);
  x = (x & 0x0f0f0f0fu) << 4 | (x >> 4 & 0x0f0f0f0fu);
  x = (x & 0x33333333u) << 2 | (x >> 2 & 0x33333333u);
  return (x & 0x55555555u) << 1 | (x >> 1 & 0x55555555u);
}

// Owen scrambling of a bit-reversed number: each bit is flipped depending on the bits below it only
// (Laine & Karras 2011, with the constants of Vegdahl 2021).
std::uint32_t scramble_reversed(std::uint32_t x, std::uint32_t seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

// Second dimension of Sobol's sequence, bit-reversed. Its generator matrix is Pascal's triangle modulo 2, and C(j, i)
// is odd where the bits of i are among those of j: bit i of the result is the sum of all index bits j that contain i, a
// superset transform of five butterflies.
std::uint32_t sobol_second_reversed(std::uint32_t index) {
  index ^= (index & 0xaaaaaaaau) >> 1;
  index ^= (index & 0xccccccccu) >> 2;
  index ^= (index & 0xf0f0f0f0u) >> 4;
  index ^= (index & 0xff00ff00u) >> 8;
  return index ^ (index & 0xffff0000u) >> 16;
}

float unit_float(std::uint32_t bits) {
  return static_cast<float>(bits >> 8) * 0x1p-24f;
}

}  // namespace

std::uint64_t mix64(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
  x = (x ^ x >> 27) * 0x94d049bb133111ebu;
  return x ^ x >> 31;
}

Sampler::Sampler(std::uint64_t seed, std::uint64_t stream, std::uint32_t sample)
    : key_(mix64(mix64(seed) ^ stream)), reversed_sample_(reverse_bits(sample)) {}

// Owen-scrambled sample index.
inline std::uint32_t Sampler::shuffled_index(std::uint64_t hash) const {
  return reverse_bits(scramble_reversed(reversed_sample_, static_cast<std::uint32_t>(hash)));
}

float Sampler::next1() {
  const std::uint64_t h = mix64(key_ + dimension_++);
  // Dimension 0 of Sobol's sequence is the bit-reversed index: shuffling and scrambling act on the reversed bits alone.
  const std::uint32_t index = shuffled_index(h);
  return unit_float(reverse_bits(scramble_reversed(index, static_cast<std::uint32_t>(h >> 32))));
}

Vec2 Sampler::next2() {
  const std::uint64_t h = mix64(key_ + dimension_++), g = mix64(h);
  const std::uint32_t index = shuffled_index(h);
  const std::uint32_t x = reverse_bits(scramble_reversed(index, static_cast<std::uint32_t>(h >> 32)));
  const std::uint32_t y = reverse_bits(scramble_reversed(sobol_second_reversed(index), static_cast<std::uint32_t>(g)));
  return {unit_float(x), unit_float(y)};
}

ShiftedNet::ShiftedNet(std::uint64_t seed, std::uint32_t count) : seed_(mix64(seed)) {
  digits_.reserve(count);
  for (std::uint32_t k = 0; k < count; ++k) digits_.emplace_back(Sampler(seed, 0, k).next2() * 0x1p24f);
  for (UVec2& d : digits_) d <<= 8u;
}

UVec2 ShiftedNet::shift(std::uint64_t stream) const {
  const std::uint64_t h = mix64(seed_ ^ stream);
  return {static_cast<std::uint32_t>(h), static_cast<std::uint32_t>(h >> 32)};
}

}  // namespace oriel
