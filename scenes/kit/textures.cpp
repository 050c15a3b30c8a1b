#include "scenes/kit/textures.h"

#include <algorithm>
#include <array>
#include <functional>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace oriel::sample {
namespace {

// A hash of two integers to [0,1): the finaliser of MurmurHash3 over their mix.
float noise(int x, int y) {
  auto h = static_cast<std::uint32_t>(x) * 0x9E3779B1u ^ static_cast<std::uint32_t>(y) * 0x85EBCA77u;
  h ^= h >> 16;
  h *= 0x85EBCA6Bu;
  h ^= h >> 13;
  h *= 0xC2B2AE35u;
  h ^= h >> 16;
  return static_cast<float>(h >> 8) / 16777216.0f;
}

// Value noise of period `period` cells over [0,1]²; smooth, so that textures repeat without a seam.
float smooth_noise(float u, float v, int period, int seed) {
  const float x = u * static_cast<float>(period), y = v * static_cast<float>(period);
  const int ix = static_cast<int>(std::floor(x)), iy = static_cast<int>(std::floor(y));
  const auto fade = [](float t) { return t * t * (3 - 2 * t); };
  const float fx = fade(x - std::floor(x)), fy = fade(y - std::floor(y));
  const auto value = [&](int dx, int dy) {
    return noise((ix + dx) % period + seed * 131, (iy + dy) % period + seed * 717);
  };
  const float low = value(0, 0) + fx * (value(1, 0) - value(0, 0));
  const float high = value(0, 1) + fx * (value(1, 1) - value(0, 1));
  return low + fy * (high - low);
}

void append(void* context, void* data, int size) {
  const auto* p = static_cast<const std::byte*>(data);
  static_cast<Bytes*>(context)->insert(static_cast<Bytes*>(context)->end(), p, p + size);
}

// color(u, v): sRGB in [0,1] at texel centres, v downwards.
PngTexture paint(std::string name, int size, const std::function<Vec3(float, float)>& color) {
  std::vector<std::uint8_t> texels;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const float n = static_cast<float>(size);
      const Vec3 c = color((static_cast<float>(x) + 0.5f) / n, (static_cast<float>(y) + 0.5f) / n);
      for (int k = 0; k < 3; ++k) {
        texels.push_back(static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(c[k], 0.0f, 1.0f))));
      }
    }
  }
  PngTexture texture{std::move(name), {}};
  stbi_write_png_to_func(append, &texture.png, size, size, 3, texels.data(), size * 3);
  return texture;
}

Vec3 hex(std::uint32_t rgb) {
  return Vec3(static_cast<float>(rgb >> 16 & 255), static_cast<float>(rgb >> 8 & 255), static_cast<float>(rgb & 255)) /
         255.0f;
}

}  // namespace

PngTexture dark_tiles(int size) {
  return paint("dark tiles", size, [](float u, float v) {
    const float x = u * 4, y = v * 4;
    const int ix = static_cast<int>(x), iy = static_cast<int>(y);
    const float fx = x - std::floor(x), fy = y - std::floor(y);
    const float edge = std::min(std::min(fx, 1 - fx), std::min(fy, 1 - fy));
    if (edge < 0.012f) return hex(0x8A8378);
    const bool light = (ix + iy) % 2 == 0;
    const float cloud = 0.6f * smooth_noise(u, v, 16, ix * 4 + iy) + 0.4f * smooth_noise(u, v, 64, 3);
    const float shade = 0.85f + 0.3f * cloud + 0.1f * (noise(ix, iy) - 0.5f);
    return (light ? hex(0x5C5B58) : hex(0x302F33)) * shade;
  });
}

PngTexture oak_planks(int size) {
  return paint("oak planks", size, [](float u, float v) {
    const float x = u * 8;
    const int plank = static_cast<int>(x);
    const float fx = x - std::floor(x);
    const float shift = noise(plank, 91);
    const float along = v + shift - std::floor(v + shift);
    const bool joint = fx < 0.02f || fx > 0.98f || along < 0.003f || along > 0.997f;
    if (joint) return hex(0x4A3620);
    const float grain = smooth_noise(u, v, 128, 5) * 0.35f + 0.65f * smooth_noise(fx * 0.5f + shift, along, 24, plank);
    return glm::mix(hex(0x9A7346), hex(0xC79F68), grain) * (0.92f + 0.16f * noise(plank, 17));
  });
}

PngTexture painting_blocks(int size) {
  struct Rect {
    float x0, y0, x1, y1;
    std::uint32_t color;
  };
  static constexpr std::array<Rect, 8> kRects{{{0.00f, 0.00f, 0.62f, 0.55f, 0xC8201E},
                                               {0.66f, 0.00f, 1.00f, 0.26f, 0xF2EFE4},
                                               {0.66f, 0.30f, 1.00f, 0.55f, 0xF0C818},
                                               {0.00f, 0.59f, 0.24f, 1.00f, 0xF2EFE4},
                                               {0.28f, 0.59f, 0.62f, 0.80f, 0x1D4EA3},
                                               {0.28f, 0.84f, 0.62f, 1.00f, 0xF2EFE4},
                                               {0.66f, 0.59f, 0.86f, 1.00f, 0xF2EFE4},
                                               {0.90f, 0.59f, 1.00f, 1.00f, 0x1D4EA3}}};
  return paint("painting blocks", size, [](float u, float v) {
    for (const Rect& r : kRects) {
      if (u >= r.x0 && u < r.x1 && v >= r.y0 && v < r.y1) return hex(r.color);
    }
    return hex(0x151515);
  });
}

PngTexture painting_hills(int size) {
  return paint("painting hills", size, [](float u, float v) {
    Vec3 color = glm::mix(hex(0x2B4C7E), hex(0xF3B06A), std::clamp(v * 1.7f, 0.0f, 1.0f));
    const float sun = glm::length(Vec2(u - 0.68f, v - 0.42f));
    if (sun < 0.07f) color = hex(0xFFE8B0);
    static constexpr std::array<std::uint32_t, 4> kRanges{0x8A6C86, 0x5E5273, 0x3B4A57, 0x22382F};
    for (int i = 0; i < 4; ++i) {
      const float f = static_cast<float>(i);
      const float ridge = 0.46f + 0.13f * f - 0.09f * std::sin(u * (5.0f + 2.3f * f) + 1.7f * f) -
                          0.10f * smooth_noise(u, 0.5f, 8 + 4 * i, 40 + i);
      if (v > ridge) color = hex(kRanges[static_cast<std::size_t>(i)]);
    }
    return color;
  });
}

PngTexture painting_circles(int size) {
  struct Ring {
    float x, y, r, width;
    std::uint32_t color;
  };
  static constexpr std::array<Ring, 6> kRings{{{0.35f, 0.40f, 0.25f, 0.05f, 0xD94E2A},
                                               {0.62f, 0.55f, 0.28f, 0.04f, 0x1E6F70},
                                               {0.50f, 0.72f, 0.16f, 0.03f, 0x23284B},
                                               {0.75f, 0.25f, 0.11f, 0.11f, 0xE8B838},
                                               {0.22f, 0.78f, 0.09f, 0.09f, 0x23284B},
                                               {0.62f, 0.55f, 0.08f, 0.08f, 0xD94E2A}}};
  return paint("painting circles", size, [](float u, float v) {
    Vec3 color = hex(0xEDE3CF) * (0.97f + 0.05f * smooth_noise(u, v, 32, 9));
    for (const Ring& ring : kRings) {
      const float d = glm::length(Vec2(u - ring.x, v - ring.y));
      if (d <= ring.r && d >= ring.r - ring.width) color = hex(ring.color);
    }
    return color;
  });
}

PngTexture painting_stripes(int size) {
  static constexpr std::array<std::uint32_t, 5> kColors{0x0E7C7B, 0xD4F4DD, 0xD62246, 0x4B1D3F, 0x17BEBB};
  return paint("painting stripes", size, [](float u, float v) {
    const float x = u * 14 + 0.35f * smooth_noise(u, v, 8, 21);
    const int band = static_cast<int>(x);
    const auto pick = static_cast<std::size_t>(noise(band, 5) * 5.0f);
    return hex(kColors[std::min<std::size_t>(pick, 4)]);
  });
}

}  // namespace oriel::sample
