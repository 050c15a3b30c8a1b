// Positions as keys of hash tables.
#pragma once

#include <bit>
#include <cstdint>

#include "formats/core/vec.h"

namespace oriel {

// Of equal positions the same: of -0 and 0 too.
struct PositionHash {
  std::size_t operator()(const Vec3& p) const {
    std::uint64_t h = 0;
    for (int k = 0; k < 3; ++k) {
      h = (h ^ std::bit_cast<std::uint32_t>(p[k] + 0.0f)) * 0x9e3779b97f4a7c15u;
      h ^= h >> 29;
    }
    return static_cast<std::size_t>(h);
  }
};

}  // namespace oriel
