// How blocks of BC6H are laid out (Khronos Data Format Specification 1.3, section "BPTC"; the unsigned half format).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "formats/core/vec.h"

namespace oriel::bc6h {

inline constexpr int kTexels = 16;  // of a block, row by row
inline constexpr int kPartitions = 32;

// Endpoints w, x are those of the first line, y, z of the second. Of modes with differences all but w are stored as
// signed differences from w.
struct Mode {
  std::uint32_t code;
  int code_bits;
  int lines;             // 1: indices of 4 bits; 2: indices of 3 bits and a partition
  int bits;              // of a channel of w
  glm::ivec3 more_bits;  // of the channels of x, y, z
  bool differences;
  // What follows the code, from the lowest bit: "gy4" is bit 4 of y's green, "rw9:0" its bits 0 to 9, "rw10:15" bits
  // 15 to 10.
  std::string_view layout;
};

struct Bit {
  std::uint8_t endpoint, channel, bit;
};

std::span<const Mode, 14> modes();
// The bits of a mode's endpoints in their order.
std::span<const Bit> bits_of(std::size_t mode);

// Bit i: texel i is on the second line.
std::uint16_t partition_mask(std::uint32_t partition);
// The texel of the second line whose index has its highest bit left out: it is 0. Of the first line that is texel 0.
int anchor(std::uint32_t partition);

// The 16 bits that an endpoint's channel stands for.
inline std::uint32_t unquantised(std::uint32_t q, int bits) {
  if (bits >= 15) return q;
  if (q == 0) return 0;
  if (q == (1u << bits) - 1) return 0xFFFF;
  return ((q << 15) + 0x4000) >> (bits - 1);
}

// Of 64, by index.
std::span<const std::uint8_t> weights(int lines);

// The half float on a line.
inline std::uint16_t half_between(std::uint32_t a, std::uint32_t b, std::uint32_t weight) {
  const std::uint32_t between = (a * (64 - weight) + b * weight + 32) >> 6;
  return static_cast<std::uint16_t>((between * 31) >> 6);
}

}  // namespace oriel::bc6h
