#include "formats/image/display.h"

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

FloatImage shown_variance(const FloatImage& light, const FloatImage& noise, float white) {
  FloatImage above = light, below = light;
  for (std::size_t i = 0; i < light.pixels.size(); ++i) {
    above.pixels[i] += noise.pixels[i];
    below.pixels[i] -= noise.pixels[i];
  }
  FloatImage out = squared_difference(shown(above, white), shown(below, white));
  for (float& v : out.pixels) v *= 0.25f;
  return out;
}

FloatImage squared_difference(const FloatImage& a, const FloatImage& b) {
  FloatImage out = a;
  for (std::size_t i = 0; i < out.pixels.size(); ++i)
    out.pixels[i] = (a.pixels[i] - b.pixels[i]) * (a.pixels[i] - b.pixels[i]);
  return out;
}

double psnr_db(double mean_squared_difference) {
  constexpr double kMost = 99;
  return mean_squared_difference > 0 ? std::min(kMost, -10 * std::log10(mean_squared_difference)) : kMost;
}

}  // namespace oriel
