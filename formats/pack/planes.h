// Arrays as byte planes: first byte 0 of every element, then byte 1 of every element, …, each byte stored as its
// difference from the one before in the same plane (modulo 256). Neighbouring elements share their high bytes, so that
// zstd finds runs where it saw none: measured in docs/notes/format.md.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <utility>
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

// Elements of planes, some at a time: so many that what is made of them lies in the nearest cache.
inline constexpr std::size_t kPlaneBlock = 512;
template <std::size_t kWidth>
struct PlaneBlock {
  std::array<std::array<unsigned char, kPlaneBlock>, kWidth> plane;  // byte b of element i is plane[b][i]
  std::size_t size = 0;                                              // elements
};

// take(block) for count elements of kWidth bytes in order; never, with in not ok, where fewer are left.
template <std::size_t kWidth, class Take>
void for_each_plane_block(ByteReader& in, std::uint64_t count, const Take& take) {
  const bool enough = count <= in.remaining() / kWidth;
  const auto bytes = in.get_span(enough ? count * kWidth : ~std::uint64_t{0});
  const auto* from = reinterpret_cast<const unsigned char*>(bytes.data());
  PlaneBlock<kWidth> block;
  std::array<unsigned char, kWidth> last{};
  for (std::size_t first = 0; enough && first < count; first += block.size) {
    block.size = std::min<std::size_t>(kPlaneBlock, count - first);
    for (std::size_t b = 0; b < kWidth; ++b) {
      unsigned char byte = last[b];
      for (std::size_t i = 0; i < block.size; ++i)
        block.plane[b][i] = byte = static_cast<unsigned char>(byte + from[b * count + first + i]);
      last[b] = byte;
    }
    take(std::as_const(block));
  }
}

// count elements; empty, with in not ok, where fewer are left.
template <Planar T>
std::vector<T> get_planes(ByteReader& in, std::uint64_t count) {
  std::vector<T> values;
  for_each_plane_block<sizeof(T)>(in, count, [&](const PlaneBlock<sizeof(T)>& block) {
    if (values.empty()) values.reserve(count);
    std::array<T, kPlaneBlock> made;
    auto* to = reinterpret_cast<unsigned char*>(made.data());
    for (std::size_t i = 0; i < block.size; ++i)
      for (std::size_t b = 0; b < sizeof(T); ++b) to[i * sizeof(T) + b] = block.plane[b][i];
    values.insert(values.end(), made.begin(), made.begin() + static_cast<std::ptrdiff_t>(block.size));
  });
  return values;
}

}  // namespace oriel
