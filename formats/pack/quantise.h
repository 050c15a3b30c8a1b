// How numbers lose bits in a pack. Each encoding gives back the same code for its own decoded value, so that reading
// and writing a pack again changes no byte. docs/notes/format.md states the errors.
#pragma once

#include <cstdint>

#include "formats/core/vec.h"

namespace oriel {

// A map's floats are stored divided by 2^exponent, so that small formats cover any scene's range.
inline constexpr int kMinScaleExponent = -94;
inline constexpr int kMaxScaleExponent = 112;

// The exponent that brings the largest value (>= 0, finite) into [2^14, 2^15) once it is rounded to mantissa_bits
// (11: half, 9: RGB9E5). Values below 2^-80 count as nothing: exponent 0, under which they become 0.
int scale_exponent(float largest, int mantissa_bits);

// Unit vectors in 2 x 16 bits, x in the low half. Error at most 7e-5 rad.
// Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit Vectors", oct32.
std::uint32_t octahedral_from_normal(const Vec3& normal);
Vec3 normal_from_octahedral(std::uint32_t code);  // unit for every code

// Disparities in [0, 1] as code / 65535 / 2^shift; the shift fits the map's largest one, and is in [0, 30]. 0 and 1
// are exact; the error is at most 1/131070 of 2^-shift.
inline constexpr int kMaxDisparityShift = 30;
int disparity_shift(float largest);
std::uint16_t code_from_disparity(float disparity, int shift);
float disparity_from_code(std::uint16_t code, int shift);

}  // namespace oriel
