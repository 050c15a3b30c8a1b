// Arrays as byte planes: first byte 0 of every element, then byte 1 of every element, …, each byte stored as its
// difference from the one before in the same plane (modulo 256). Neighbouring elements share their high bytes, so that
// zstd finds runs where it saw none: measured in docs/format.md.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "formats/core/bytes.h"

namespace oriel {

// Scalars, and structs of them without padding. GLM's vectors initialise themselves, so they are not trivially copyable
// in the language's sense, but their bytes are their floats.
template <class T>
concept Planar = std::is_standard_layout_v<T> && std::is_trivially_destructible_v<T>;

template <Planar T>
void put_planes(ByteWriter& out, std::span<const T> values) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
  std::vector<unsigned char> plane(values.size());
  for (std::size_t b = 0; b < sizeof(T); ++b) {
    unsigned char before = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const unsigned char byte = bytes[i * sizeof(T) + b];
      plane[i] = static_cast<unsigned char>(byte - before);
      before = byte;
    }
    out.put_array(std::span<const unsigned char>(plane));
  }
}

// count elements; empty, with in not ok, where fewer are left.
template <Planar T>
std::vector<T> get_planes(ByteReader& in, std::uint64_t count) {
  const auto planes = in.get_array<std::array<unsigned char, sizeof(T)>>(count);
  std::vector<T> values(planes.size());
  const auto* from = reinterpret_cast<const unsigned char*>(planes.data());
  auto* to = reinterpret_cast<unsigned char*>(values.data());
  for (std::size_t b = 0; b < sizeof(T); ++b) {
    unsigned char byte = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      byte = static_cast<unsigned char>(byte + *from++);
      to[i * sizeof(T) + b] = byte;
    }
  }
  return values;
}

}  // namespace oriel
