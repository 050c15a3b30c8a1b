// Small float encodings. Out-of-range values are clamped to the largest finite one, never turned into infinity;
// NaN and negative radiance become 0.
#pragma once

#include <bit>
#include <cstdint>

#include "formats/core/vec.h"

namespace oriel {

inline constexpr float kHalfMax = 65504.0f;
inline constexpr float kRgb9e5Max = 65408.0f;

// IEEE binary16, round to nearest even. Relative error at most 2^-11 for |x| in [6.1e-5, 65504].
std::uint16_t half_from_float(float x);
float float_from_half(std::uint16_t h);
// The same of one that is finite and not negative (h < 0x7c00), many at once: a compiler makes vectors of it.
inline float float_from_positive_half(std::uint16_t h) {
  const float tiny = static_cast<float>(h) * 0x1p-24f;  // below 2^-14 there is no leading one
  const float normal = std::bit_cast<float>((std::uint32_t{h} << 13) + (std::uint32_t{127 - 15} << 23));
  return h < 0x400 ? tiny : normal;
}

// GL_RGB9_E5: shared exponent, 9-bit mantissas; non-negative. Error at most 2^-9 of the largest channel.
std::uint32_t rgb9e5_from_rgb(const Vec3& rgb);
Vec3 rgb_from_rgb9e5(std::uint32_t packed);

}  // namespace oriel
