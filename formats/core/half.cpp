#include "formats/core/half.h"

#include <Imath/half.h>

#include <algorithm>

namespace oriel {

std::uint16_t half_from_float(float x) {
  if (std::isnan(x)) return 0;
  return Imath::half(std::clamp(x, -kHalfMax, kHalfMax)).bits();
}

float float_from_half(std::uint16_t h) {
  Imath::half value;
  value.setBits(h);
  return static_cast<float>(value);
}

std::uint32_t rgb9e5_from_rgb(const Vec3& rgb) {
  // OpenGL 4.5 core, section 8.5.2 "Encoding of Special Internal Formats".
  const auto clamped = [](float c) { return c > 0 ? std::min(c, kRgb9e5Max) : 0.0f; };  // NaN compares false: 0
  const Vec3 c(clamped(rgb.r), clamped(rgb.g), clamped(rgb.b));
  const float largest = max_component(c);
  if (largest <= 0) return 0;
  int exponent = std::max(-16, std::ilogb(largest)) + 16;  // 1 + bias 15
  if (std::floor(std::ldexp(largest, 24 - exponent) + 0.5f) >= 512.0f) ++exponent;
  const auto mantissa = [exponent](float x) {
    return static_cast<std::uint32_t>(std::floor(std::ldexp(x, 24 - exponent) + 0.5f));
  };
  return mantissa(c.r) | mantissa(c.g) << 9 | mantissa(c.b) << 18 | static_cast<std::uint32_t>(exponent) << 27;
}

Vec3 rgb_from_rgb9e5(std::uint32_t packed) {
  const int exponent = static_cast<int>(packed >> 27) - 24;
  const auto channel = [&](int shift) { return std::ldexp(static_cast<float>(packed >> shift & 511u), exponent); };
  return {channel(0), channel(9), channel(18)};
}

}  // namespace oriel
