#include "formats/metrics/display.h"

#include <algorithm>
#include <cmath>

#include "formats/core/color.h"

namespace oriel {

float white_of(const FloatImage& light) {
  constexpr double kMiddleGrey = 0.18;
  double sum = 0, count = 0;
  for (std::size_t i = 0; i + 2 < light.pixels.size(); i += light.channels) {
    const float y = luminance(Vec3(light.pixels[i], light.pixels[i + 1], light.pixels[i + 2]));
    if (!(y > 0) || !std::isfinite(y)) continue;
    sum += std::log(double{y});
    ++count;
  }
  return count > 0 ? static_cast<float>(std::exp(sum / count) / kMiddleGrey) : 1.0f;
}

FloatImage shown(const FloatImage& light, float white) {
  FloatImage out{light.width, light.height, 3, {}};
  out.pixels.reserve(std::size_t{light.width} * light.height * 3);
  for (std::size_t i = 0; i + 2 < light.pixels.size(); i += light.channels)
    for (std::size_t c = 0; c < 3; ++c)
      out.pixels.push_back(srgb_from_linear(std::clamp(light.pixels[i + c] / white, 0.0f, 1.0f)));
  return out;
}

double psnr(const FloatImage& a, const FloatImage& b, const Region& region) {
  constexpr double kMost = 99;
  double squares = 0, count = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    if (!counts(region, i / a.channels)) continue;
    const double d = double{a.pixels[i]} - b.pixels[i];
    squares += d * d;
    ++count;
  }
  return squares > 0 ? std::min(kMost, -10 * std::log10(squares / count)) : kMost;
}

}  // namespace oriel
