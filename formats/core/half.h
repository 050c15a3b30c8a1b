// Small float encodings. Out-of-range values are clamped to the largest finite one, never turned into infinity;
// NaN and negative radiance become 0.
#pragma once

#include "formats/core/vec.h"

namespace oriel {

inline constexpr float kHalfMax = 65504.0f;
inline constexpr float kRgb9e5Max = 65408.0f;

// IEEE binary16, round to nearest even. Relative error at most 2^-11 for |x| in [6.1e-5, 65504].
std::uint16_t half_from_float(float x);
float float_from_half(std::uint16_t h);

// GL_RGB9_E5: shared exponent, 9-bit mantissas; non-negative. Error at most 2^-9 of the largest channel.
std::uint32_t rgb9e5_from_rgb(const Vec3& rgb);
Vec3 rgb_from_rgb9e5(std::uint32_t packed);

}  // namespace oriel
