// Plain pictures in memory.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "formats/core/vec.h"

namespace oriel {

// Channel c of pixel (x, y) is at (y * width + x) * channels + c; row 0 is the top of the picture. Linear.
struct FloatImage {
  std::uint32_t width = 0, height = 0, channels = 0;  // channels: 1 (Y), 3 (RGB) or 4 (RGBA)
  std::vector<float> pixels;
};

// The same with 8 bits a channel; colour is sRGB-encoded by the caller.
struct ByteImage {
  std::uint32_t width = 0, height = 0, channels = 0;  // channels: 1 (grey), 3 (RGB) or 4 (RGBA)
  std::vector<std::uint8_t> pixels;
};

inline FloatImage rgb_image(std::uint32_t width, std::uint32_t height, std::span<const Vec3> values) {
  FloatImage image{width, height, 3, {}};
  image.pixels.reserve(values.size() * 3);
  for (const Vec3& v : values) image.pixels.insert(image.pixels.end(), {v.r, v.g, v.b});
  return image;
}

}  // namespace oriel
