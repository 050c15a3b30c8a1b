#include "player/output/split.h"

#include <algorithm>
#include <cmath>

namespace oriel {
namespace {

template <class Image>
Image joined(const Image& left, const Image& right, float divider) {
  const auto column = static_cast<std::ptrdiff_t>(split_column(divider, static_cast<int>(left.width)));
  const std::ptrdiff_t channels = left.channels, stride = channels * static_cast<std::ptrdiff_t>(left.width);
  Image out = right;
  for (std::ptrdiff_t y = 0; y < static_cast<std::ptrdiff_t>(left.height); ++y)
    std::copy_n(left.pixels.begin() + y * stride, column * channels, out.pixels.begin() + y * stride);
  return out;
}

}  // namespace

int split_column(float divider, int width) {
  const float share = std::isfinite(divider) ? std::clamp(divider, 0.0f, 1.0f) : 0.5f;
  return static_cast<int>(std::lround(share * static_cast<float>(width)));
}

ByteImage join_split(const ByteImage& left, const ByteImage& right, float divider) {
  return joined(left, right, divider);
}

FloatImage join_split(const FloatImage& left, const FloatImage& right, float divider) {
  return joined(left, right, divider);
}

}  // namespace oriel
