#include "formats/core/half.h"

#include <Imath/half.h>

#include <algorithm>

namespace oriel {
namespace {

// 2 to the power of an exponent within a normal float's; times it is what ldexp is, in a tenth of the time.
float power_of_two(int exponent) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(exponent + 127) << 23);
}

}  // namespace

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
  const int log2 = static_cast<int>(std::bit_cast<std::uint32_t>(largest) >> 23) - 127;
  int exponent = std::max(-16, log2) + 16;  // 1 + bias 15
  if (largest * power_of_two(24 - exponent) + 0.5f >= 512.0f) ++exponent;
  const float scale = power_of_two(24 - exponent);
  const auto mantissa = [scale](float x) { return static_cast<std::uint32_t>(x * scale + 0.5f); };
  return mantissa(c.r) | mantissa(c.g) << 9 | mantissa(c.b) << 18 | static_cast<std::uint32_t>(exponent) << 27;
}

Vec3 rgb_from_rgb9e5(std::uint32_t packed) {
  const float scale = power_of_two(static_cast<int>(packed >> 27) - 24);
  const auto channel = [&](int shift) { return static_cast<float>(packed >> shift & 511u) * scale; };
  return {channel(0), channel(9), channel(18)};
}

}  // namespace oriel
