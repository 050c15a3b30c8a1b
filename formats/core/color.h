// Colour: linear Rec. 709 everywhere; sRGB only at 8-bit files and screens.
#pragma once

#include "formats/core/vec.h"

namespace oriel {

// Luminance (or illuminance) of linear Rec. 709 light: the Y of CIE XYZ.
inline float luminance(const Vec3& rgb) {
  return 0.2126f * rgb.r + 0.7152f * rgb.g + 0.0722f * rgb.b;
}
inline double luminance(const DVec3& rgb) {
  return 0.2126 * rgb.r + 0.7152 * rgb.g + 0.0722 * rgb.b;
}

// IEC 61966-2-1. Both take and return [0, 1]; outside it they extend without clamping (negative: 0).
float linear_from_srgb(float encoded);
float srgb_from_linear(float linear);
inline Vec3 linear_from_srgb(const Vec3& c) {
  return {linear_from_srgb(c.r), linear_from_srgb(c.g), linear_from_srgb(c.b)};
}
inline Vec3 srgb_from_linear(const Vec3& c) {
  return {srgb_from_linear(c.r), srgb_from_linear(c.g), srgb_from_linear(c.b)};
}

// An 8-bit sRGB code value as linear [0, 1], from a table.
float linear_from_srgb8(std::uint8_t code);

}  // namespace oriel
