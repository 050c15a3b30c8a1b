// Which pixels of a picture count.
#pragma once

#include <cstdint>
#include <span>

#include "formats/image/image.h"

namespace oriel {

// By pixel, row by row: 0 where it does not count. Empty: all do.
using Region = std::span<const std::uint8_t>;

inline bool counts(const Region& region, std::size_t pixel) {
  return region.empty() || region[pixel] != 0;
}

// Mean of a picture's values over a region; 0 where the region is empty of pixels.
inline double mean_over(const FloatImage& image, const Region& region = {}) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    if (!counts(region, i / image.channels)) continue;
    sum += image.pixels[i];
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

}  // namespace oriel
