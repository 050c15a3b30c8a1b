// Points that fill a square evenly, however many are taken.
#pragma once

#include <cmath>
#include <cstdint>

#include "formats/core/vec.h"

namespace oriel {

// Point `index` of R2 (Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences") in [0, 1)², shifted as
// a whole for each `row`, so that neighbours do not share their errors.
inline Vec2 shifted_r2(std::uint32_t index, std::uint32_t row) {
  const auto fraction = [](double x) { return static_cast<float>(x - std::floor(x)); };
  const std::uint32_t a = row * 0x9e3779b9u, b = (row ^ 0x68bc21ebu) * 0x85ebca6bu;
  return {fraction(index * 0.7548776662466927 + (a ^ a >> 15) * 0x1p-32),
          fraction(index * 0.5698402909980532 + (b ^ b >> 13) * 0x1p-32)};
}

}  // namespace oriel
