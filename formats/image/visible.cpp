#include "formats/image/visible.h"

#include <algorithm>
#include <cmath>

#include "formats/core/color.h"
#include "formats/image/contrast_sensitivity.h"
#include "formats/image/filter.h"

namespace oriel {
namespace {

constexpr float kGlare = 0.01f;          // of white
constexpr int kLeastSide = 4;            // pixels of the coarsest level
constexpr double kWindow = 2, kRms = 2;  // sigmas in pixels of a level: of light around, of what is one grating's

float at(const Plane& plane, int x, int y) {
  x = std::clamp(x, 0, plane.width - 1), y = std::clamp(y, 0, plane.height - 1);
  return plane.values[static_cast<std::size_t>(y * plane.width + x)];
}

Plane shown_light(const FloatImage& image, float white) {
  Plane plane{static_cast<int>(image.width), static_cast<int>(image.height), {}};
  for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
    const float light = luminance(Vec3(image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]));
    plane.values.push_back(std::clamp(light / white, 0.0f, 1.0f));
  }
  return plane;
}

Plane smooth(const Plane& plane, double sigma) {
  const auto kernel = gaussian(sigma, static_cast<int>(std::ceil(3 * sigma)));
  return filtered(plane, kernel, kernel);
}

// Half as wide and as high: what is finer than that is gone.
Plane coarser(const Plane& plane) {
  const std::vector<double> binomial = {1 / 16.0, 4 / 16.0, 6 / 16.0, 4 / 16.0, 1 / 16.0};
  const Plane soft = filtered(plane, binomial, binomial);
  Plane out{(plane.width + 1) / 2, (plane.height + 1) / 2, {}};
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) out.values.push_back(at(soft, 2 * x, 2 * y));
  return out;
}

// Pixel (x, y) of the finer level lies at (x, y) / scale.
float between(const Plane& plane, float x, float y) {
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
  return (1 - fy) * ((1 - fx) * at(plane, x0, y0) + fx * at(plane, x0 + 1, y0)) +
         fy * ((1 - fx) * at(plane, x0, y0 + 1) + fx * at(plane, x0 + 1, y0 + 1));
}

// An octave: a level less what the next shows of it.
Plane band_of(const Plane& level, const Plane& next) {
  Plane out = level;
  for (int y = 0; y < level.height; ++y)
    for (int x = 0; x < level.width; ++x)
      out.values[static_cast<std::size_t>(y * level.width + x)] -=
          between(next, 0.5f * static_cast<float>(x), 0.5f * static_cast<float>(y));
  return out;
}

// Of gratings around a pixel: √2 of the root mean square.
Plane amplitude(Plane contrast) {
  for (float& v : contrast.values) v *= v;
  contrast = smooth(contrast, kRms);
  for (float& v : contrast.values) v = std::sqrt(2 * std::max(0.0f, v));
  return contrast;
}

double threshold_elevation(double contrast_over_threshold) {
  constexpr double kK1 = 0.0153, kK2 = 392.5, kSlope = 0.7, kSharpness = 4;
  return std::pow(1 + std::pow(kK1 * std::pow(kK2 * contrast_over_threshold, kSlope), kSharpness), 1 / kSharpness);
}

// Contrast over its threshold in one octave, by pixel of its level.
Plane visible_in(const Plane& level, const Plane& band, const Plane& off, double sensitivity) {
  Plane contrast = off, own = band, around = smooth(level, kWindow);
  for (std::size_t i = 0; i < contrast.values.size(); ++i) {
    const float light = around.values[i] + kGlare;
    contrast.values[i] /= light, own.values[i] /= light;
  }
  contrast = amplitude(std::move(contrast)), own = amplitude(std::move(own));
  for (std::size_t i = 0; i < contrast.values.size(); ++i)
    contrast.values[i] = static_cast<float>(sensitivity * double{contrast.values[i]} /
                                            threshold_elevation(sensitivity * double{own.values[i]}));
  return contrast;
}

}  // namespace

VisibleError visible_error(const FloatImage& reference, const FloatImage& test, float white, double pixels_per_degree) {
  Plane light = shown_light(reference, white), off = shown_light(test, white);
  for (std::size_t i = 0; i < off.values.size(); ++i) off.values[i] -= light.values[i];
  VisibleError out{0, 0, {reference.width, reference.height, 1, std::vector<float>(light.values.size())}};
  // The first octave ends at half a cycle a pixel; its middle is half an octave below.
  float scale = 1;
  for (double cycles = pixels_per_degree * std::sqrt(0.125); std::min(light.width, light.height) > kLeastSide;
       cycles /= 2, scale /= 2) {
    const Plane next_light = coarser(light), next_off = coarser(off);
    const Plane seen =
        visible_in(light, band_of(light, next_light), band_of(off, next_off), contrast_sensitivity(cycles));
    for (std::size_t i = 0; i < out.map.pixels.size(); ++i) {
      const float v =
          between(seen, scale * static_cast<float>(i % out.map.width), scale * static_cast<float>(i / out.map.width));
      out.map.pixels[i] += v * v;
    }
    light = next_light, off = next_off;
  }
  for (float& v : out.map.pixels) {
    out.rms += double{v};
    out.share += v > 1 ? 1 : 0;
    v = std::sqrt(v);
  }
  const auto pixels = static_cast<double>(out.map.pixels.size());
  out.rms = std::sqrt(out.rms / pixels), out.share /= pixels;
  return out;
}

}  // namespace oriel
