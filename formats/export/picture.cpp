#include "formats/export/picture.h"

#include <algorithm>

#include "formats/core/color.h"
#include "formats/core/text.h"
#include "formats/image/display.h"
#include "formats/image/png.h"

namespace oriel::report {
namespace {

constexpr std::uint8_t kUnknown = 232;
constexpr std::uint32_t kSmall = 96;  // pixels a side: smaller pictures are shown larger

// color(i): sRGB as shown, of a known pixel.
template <class Color>
std::string img(const Raster& raster, const std::string& what, const Color& color) {
  ByteImage image{raster.light.width, raster.light.height, 3, {}};
  image.pixels.reserve(3 * raster.known.size());
  for (std::size_t i = 0; i < raster.known.size(); ++i) {
    const Vec3 c = raster.known[i] != 0 ? color(i) * 255.0f + 0.5f : Vec3(kUnknown);
    for (int k = 0; k < 3; ++k) image.pixels.push_back(static_cast<std::uint8_t>(c[k]));
  }
  const auto png = encode_png(image);
  if (!png) return "<p class=\"quiet\">" + escaped(what + ": " + png.error().text()) + "</p>\n";
  const std::uint32_t larger = std::max(1u, kSmall / std::max(image.width, image.height));
  return fmt::format("<img src=\"data:image/png;base64,{}\" width=\"{}\" height=\"{}\" alt=\"{}\">\n", base64(*png),
                     image.width * larger, image.height * larger, escaped(what));
}

Vec3 at(const FloatImage& image, std::size_t i) {
  return {image.pixels[3 * i], image.pixels[3 * i + 1], image.pixels[3 * i + 2]};
}

}  // namespace

Raster flipped(const Raster& raster) {
  Raster out;
  out.light = {raster.light.width, raster.light.height, 3, {}};
  const std::size_t w = raster.light.width;
  for (std::size_t y = raster.light.height; y-- > 0;) {
    const auto light = raster.light.pixels.begin() + static_cast<std::ptrdiff_t>(3 * w * y);
    const auto known = raster.known.begin() + static_cast<std::ptrdiff_t>(w * y);
    out.light.pixels.insert(out.light.pixels.end(), light, light + static_cast<std::ptrdiff_t>(3 * w));
    out.known.insert(out.known.end(), known, known + static_cast<std::ptrdiff_t>(w));
  }
  return out;
}

float white_of(std::span<const Raster> rasters) {
  FloatImage all{0, 1, 3, {}};
  for (const Raster& r : rasters) all.pixels.insert(all.pixels.end(), r.light.pixels.begin(), r.light.pixels.end());
  all.width = static_cast<std::uint32_t>(all.pixels.size() / 3);
  return oriel::white_of(all);
}

std::string toned_img(const Raster& raster, float white, const std::string& what) {
  const FloatImage picture = shown(raster.light, white);
  return img(raster, what, [&](std::size_t i) { return at(picture, i); });
}

std::string heat_img(const Raster& raster, const HeatScale& scale, const std::string& what) {
  return img(raster, what, [&](std::size_t i) { return heat(share_of(scale, luminance(at(raster.light, i)))); });
}

}  // namespace oriel::report
