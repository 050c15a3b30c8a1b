#include "formats/pack/quantise.h"

#include <algorithm>

#include "formats/core/octahedral.h"

namespace oriel {

int scale_exponent(float largest, int mantissa_bits) {
  if (!(largest >= 0x1p-80f)) return 0;
  int exponent = 0;
  const double mantissa = std::frexp(static_cast<double>(largest), &exponent);
  // Rounded first: else the decoded maximum could ask for the next exponent, and a second encoding would differ.
  if (std::nearbyint(std::ldexp(mantissa, mantissa_bits)) >= std::ldexp(1.0, mantissa_bits)) ++exponent;
  return std::clamp(exponent - 15, kMinScaleExponent, kMaxScaleExponent);
}

std::uint32_t octahedral_from_normal(const Vec3& normal) {
  const DVec2 p = octahedral_from_direction(DVec3(normal));
  const auto snorm = [](double v) {
    return static_cast<std::uint16_t>(static_cast<std::int16_t>(std::lround(std::clamp(v, -1.0, 1.0) * 32767)));
  };
  return snorm(p.x) | static_cast<std::uint32_t>(snorm(p.y)) << 16;
}

Vec3 normal_from_octahedral(std::uint32_t code) {
  const auto component = [](std::uint32_t bits) {
    return std::max(-32767, static_cast<int>(static_cast<std::int16_t>(bits & 0xffff)));
  };
  double x = component(code), y = component(code >> 16);
  const double z = 32767 - std::abs(x) - std::abs(y);
  if (z < 0) {
    const double folded_x = std::copysign(32767 - std::abs(y), x);
    y = std::copysign(32767 - std::abs(x), y);
    x = folded_x;
  }
  const DVec3 n(x, y, z);
  return Vec3(n / glm::length(n));
}

int disparity_shift(float largest) {
  int shift = 0;
  const auto fits = [largest](int s) { return std::ldexp(static_cast<double>(largest), s) * 65535 < 65535.5; };
  while (shift < kMaxDisparityShift && fits(shift + 1)) ++shift;
  return shift;
}

std::uint16_t code_from_disparity(float disparity, int shift) {
  const double code = std::floor(std::ldexp(static_cast<double>(disparity), shift) * 65535 + 0.5);
  return static_cast<std::uint16_t>(std::clamp(code, 0.0, 65535.0));
}

float disparity_from_code(std::uint16_t code, int shift) {
  return static_cast<float>(std::ldexp(code / 65535.0, -shift));
}

}  // namespace oriel
