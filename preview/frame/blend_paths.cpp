#include "preview/frame/blend_paths.h"

#include <algorithm>
#include <array>

#include "bake/jobs/parallel.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr std::size_t kScales = 6;
constexpr float kDark = 0.02f;        // of the frame's mean: what is darker counts as that bright
constexpr float kUnsure = 6;          // by paths: how much more noise there may be than few of them tell
constexpr std::uint32_t kFewest = 4;  // paths, of which anything is believed

struct Plane {
  std::size_t width = 0, height = 0;
  std::vector<Vec3> pixels;
};

// B3 spline, whose taps are `step` apart, along one axis; beyond the frame is its last pixel.
Result<Plane> blurred(const Plane& in, std::size_t step, bool down, Context& context) {
  constexpr std::array<float, 5> kTaps{1.0f / 16, 4.0f / 16, 6.0f / 16, 4.0f / 16, 1.0f / 16};
  Plane out{in.width, in.height, std::vector<Vec3>(in.pixels.size())};
  const auto last = static_cast<std::ptrdiff_t>((down ? in.height : in.width) - 1);
  ORIEL_TRY_VOID(parallel_for(context, "", in.height, [&](std::size_t y) {
    for (std::size_t x = 0; x < in.width; ++x) {
      Vec3 sum(0);
      for (std::ptrdiff_t k = 0; k < 5; ++k) {
        const auto at = static_cast<std::ptrdiff_t>(down ? y : x) + (k - 2) * static_cast<std::ptrdiff_t>(step);
        const auto clamped = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(at, 0, last));
        sum += kTaps[static_cast<std::size_t>(k)] * in.pixels[down ? clamped * in.width + x : y * in.width + clamped];
      }
      out.pixels[y * in.width + x] = sum;
    }
  }));
  return out;
}

Result<Plane> blurred(const Plane& in, std::size_t step, Context& context) {
  ORIEL_TRY(const Plane across, blurred(in, step, false, context));
  return blurred(across, step, true, context);
}

Vec3 pixel_of(const FloatImage& image, std::size_t i) {
  return {image.pixels[3 * i], image.pixels[3 * i + 1], image.pixels[3 * i + 2]};
}

// Adds what is left of `apart` where `times` as much noise as in `noise` is taken out of it. Both are of one scale.
struct Believed {
  Plane sum;
  float times = 1;
};
Status believe(const Plane& apart, const Plane& noise, std::size_t step, Believed& believed, Context& context) {
  Plane energy{apart.width, apart.height, {}};
  for (std::size_t i = 0; i < apart.pixels.size(); ++i)
    energy.pixels.emplace_back(length2(apart.pixels[i]), length2(noise.pixels[i]), 0);
  ORIEL_TRY(energy, blurred(energy, step, context));
  ORIEL_TRY(energy, blurred(energy, 2 * step, context));
  for (std::size_t i = 0; i < apart.pixels.size(); ++i) {
    const Vec3& e = energy.pixels[i];
    if (e.x > 0) believed.sum.pixels[i] += std::max(0.0f, 1 - believed.times * e.y / e.x) * apart.pixels[i];
  }
  return {};
}

}  // namespace

Result<FloatImage> blend_paths(const PathMean& paths, const FloatImage& passes, Context& context) {
  const std::size_t width = passes.width, height = passes.height, pixels = width * height;
  Plane apart{width, height, {}}, noise{width, height, {}};
  Believed believed{{width, height, std::vector<Vec3>(pixels, Vec3(0))},
                    1 + kUnsure / static_cast<float>(std::max(paths.samples, 1u))};
  float mean = 0;
  for (std::size_t i = 0; i < pixels; ++i) mean += luminance(pixel_of(passes, i)) / static_cast<float>(pixels);
  const auto unit = [&](std::size_t i) { return std::max(luminance(pixel_of(passes, i)) + kDark * mean, 1e-30f); };
  for (std::size_t i = 0; i < pixels; ++i) {
    apart.pixels.push_back((pixel_of(paths.mean, i) - pixel_of(passes, i)) / unit(i));
    noise.pixels.push_back(pixel_of(paths.halves, i) / unit(i));
  }
  for (std::size_t scale = 0; scale <= kScales && paths.samples >= kFewest; ++scale) {
    const std::size_t step = std::size_t{1} << scale;
    if (scale == kScales) {  // what is left: the mean of large parts
      ORIEL_TRY_VOID(believe(apart, noise, step, believed, context));
      break;
    }
    ORIEL_TRY(Plane coarser, blurred(apart, step, context));
    ORIEL_TRY(Plane coarser_noise, blurred(noise, step, context));
    for (std::size_t i = 0; i < pixels; ++i)
      apart.pixels[i] -= coarser.pixels[i], noise.pixels[i] -= coarser_noise.pixels[i];
    ORIEL_TRY_VOID(believe(apart, noise, step, believed, context));
    apart = std::move(coarser), noise = std::move(coarser_noise);
  }
  FloatImage out{passes.width, passes.height, 4, {}};
  for (std::size_t i = 0; i < pixels; ++i) {
    const Vec3 light = glm::max(pixel_of(passes, i) + unit(i) * believed.sum.pixels[i], Vec3(0));
    for (int c = 0; c < 3; ++c) out.pixels.push_back(light[c]);
    out.pixels.push_back(1);
  }
  return out;
}

}  // namespace oriel
