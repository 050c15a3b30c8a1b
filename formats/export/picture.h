// Maps as pictures within a page.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "formats/image/heat.h"
#include "formats/image/image.h"

namespace oriel::report {

// Linear RGB, three channels, and which pixels mean something.
struct Raster {
  FloatImage light;
  std::vector<std::uint8_t> known;  // 0 or 1 a pixel
};

// Means of the known pixels of whole blocks, so that no side is longer than `longest`; a block without any is unknown.
// value(i): of pixel i; known(i): whether it counts.
template <class Value, class Known>
Raster reduced(std::uint32_t width, std::uint32_t height, std::uint32_t longest, const Value& value,
               const Known& known) {
  const std::uint32_t n = std::max(1u, (std::max(width, height) + longest - 1) / longest);
  const std::uint32_t w = (width + n - 1) / n, h = (height + n - 1) / n;
  Raster out;
  out.light = {w, h, 3, std::vector<float>(std::size_t{w} * h * 3)};
  out.known.resize(std::size_t{w} * h);
  std::vector<std::uint32_t> counts(std::size_t{w} * h);
  for (std::size_t i = 0; i < std::size_t{width} * height; ++i) {
    if (!known(i)) continue;
    const std::size_t to = i / width / n * w + i % width / n;
    const Vec3 v = value(i);
    for (std::size_t c = 0; c < 3; ++c) out.light.pixels[3 * to + c] += v[static_cast<int>(c)];
    ++counts[to];
  }
  for (std::size_t i = 0; i < counts.size(); ++i) {
    out.known[i] = counts[i] > 0;
    for (std::size_t c = 0; c < 3 && counts[i] > 0; ++c) out.light.pixels[3 * i + c] /= static_cast<float>(counts[i]);
  }
  return out;
}

// The last row first.
Raster flipped(const Raster& raster);

// The exposure that suits all of them: what is shown as white (formats/image/display.h).
float white_of(std::span<const Raster> rasters);

// <img> elements with the picture inside; what is not known is light grey. Text is escaped here.
std::string toned_img(const Raster& raster, float white, const std::string& what);
// False colour of the luminance.
std::string heat_img(const Raster& raster, const HeatScale& scale, const std::string& what);

}  // namespace oriel::report
