// Small fields shared by the sections' encoders and decoders.
#pragma once

#include "formats/core/bytes.h"
#include "formats/core/result.h"
#include "formats/core/vec.h"
#include "formats/pack/encoding/quantise.h"
#include "formats/pack/layout.h"

namespace oriel {

static_assert(sizeof(Vec2) == 8 && sizeof(Vec3) == 12 && sizeof(Mat4) == 64, "vectors have no padding");

inline void put(ByteWriter& out, const Vec2& v) {
  out.put(v.x);
  out.put(v.y);
}
inline void put(ByteWriter& out, const Vec3& v) {
  out.put(v.x);
  out.put(v.y);
  out.put(v.z);
}
// Column by column, as GL and glTF.
inline void put(ByteWriter& out, const Mat4& m) {
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) out.put(m[column][row]);
}

inline Vec2 get_vec2(ByteReader& in) {
  const auto x = in.get<float>(), y = in.get<float>();
  return {x, y};
}
inline Vec3 get_vec3(ByteReader& in) {
  const auto x = in.get<float>(), y = in.get<float>(), z = in.get<float>();
  return {x, y, z};
}
inline Mat4 get_mat4(ByteReader& in) {
  Mat4 m;
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) m[column][row] = in.get<float>();
  return m;
}

// A byte that chooses among 0 … last. T: an enum, or bool with last = 1.
template <class T>
Status get_choice(ByteReader& in, const char* what, std::uint8_t last, T& value) {
  const auto code = in.get<std::uint8_t>();
  if (code > last) return invalid("", "found {} {}, expected 0 to {}", what, code, last);
  value = static_cast<T>(code);
  return {};
}

// What values were divided by before they became halves: 2 to this.
inline Status get_scale_exponent(ByteReader& in, int& exponent) {
  exponent = in.get<std::int32_t>();
  if (exponent < kMinScaleExponent || exponent > kMaxScaleExponent)
    return invalid("", "found scale exponent {}, expected {} to {}", exponent, kMinScaleExponent, kMaxScaleExponent);
  return {};
}

// Width and height of a map: two u32. The product fits in 32 bits.
inline Status get_size(ByteReader& in, std::uint32_t& width, std::uint32_t& height) {
  width = in.get<std::uint32_t>();
  height = in.get<std::uint32_t>();
  if (in.ok() && (width == 0 || height == 0 || width > kMaxSide || height > kMaxSide))
    return invalid("", "found {} x {} texels, expected 1 to {} a side", width, height, kMaxSide);
  return {};
}

}  // namespace oriel
