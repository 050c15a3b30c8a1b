#include "formats/core/color.h"

#include <array>

namespace oriel {

float linear_from_srgb(float encoded) {
  if (!(encoded > 0)) return 0;
  return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

float srgb_from_linear(float linear) {
  if (!(linear > 0)) return 0;
  return linear <= 0.0031308f ? linear * 12.92f : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

float linear_from_srgb8(std::uint8_t code) {
  static const auto table = [] {
    std::array<float, 256> values{};
    for (int i = 0; i < 256; ++i) values[i] = linear_from_srgb(static_cast<float>(i) / 255.0f);
    return values;
  }();
  return table[code];
}

}  // namespace oriel
