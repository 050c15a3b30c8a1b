#include "player/output/fit_picture.h"

#include <algorithm>

namespace oriel {
namespace {

// How much of the picture's pixels along an axis a pixel of the frame covers.
struct Cover {
  std::size_t first = 0;
  std::vector<double> weights;  // sum 1; none beside the picture
};

// from: where the frame's first pixel begins, in pixels of the picture; step: of them, a frame's pixel.
std::vector<Cover> covers(std::uint32_t frame, std::uint32_t picture, double from, double step) {
  std::vector<Cover> out(frame);
  for (std::uint32_t i = 0; i < frame; ++i) {
    const double lower = std::max(from + i * step, 0.0),
                 upper = std::min(from + (i + 1) * step, static_cast<double>(picture));
    if (!(upper - lower > 1e-6 * step)) continue;
    out[i].first = static_cast<std::size_t>(lower);
    for (std::size_t p = out[i].first; static_cast<double>(p) < upper; ++p) {
      const double share = std::min(upper, static_cast<double>(p + 1)) - std::max(lower, static_cast<double>(p));
      out[i].weights.push_back(share / (upper - lower));
    }
  }
  return out;
}

}  // namespace

FloatImage fit_picture(const FloatImage& picture, std::uint32_t width, std::uint32_t height, float alpha) {
  const double step = static_cast<double>(picture.height) / height;
  const std::vector<Cover> across =
      covers(width, picture.width, 0.5 * (static_cast<double>(picture.width) - width * step), step);
  const std::vector<Cover> down = covers(height, picture.height, 0, step);
  FloatImage out{width, height, 4, std::vector<float>(std::size_t{width} * height * 4)};
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x) {
      if (across[x].weights.empty()) continue;
      DVec3 sum(0);
      for (std::size_t j = 0; j < down[y].weights.size(); ++j)
        for (std::size_t i = 0; i < across[x].weights.size(); ++i) {
          const std::size_t row = std::min<std::size_t>(down[y].first + j, picture.height - 1);
          const std::size_t column = std::min<std::size_t>(across[x].first + i, picture.width - 1);
          const float* rgb = &picture.pixels[(row * picture.width + column) * picture.channels];
          sum += down[y].weights[j] * across[x].weights[i] * DVec3(rgb[0], rgb[1], rgb[2]);
        }
      float* rgba = &out.pixels[4 * (y * width + x)];
      for (int c = 0; c < 3; ++c) rgba[c] = static_cast<float>(sum[c]);
      rgba[3] = alpha;
    }
  return out;
}

}  // namespace oriel
