// What is measured of a frame beside its reference.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/image/exr.h"
#include "formats/image/relative_error.h"

namespace oriel {

// A frame as the player draws it, of the reference's size. cd/m², three channels.
struct PlayedFrame {
  FloatImage total, diffuse, specular;  // specular: (M * K) R where a reflector shows its image
  std::vector<std::uint8_t> mirrors;    // by pixel: 1 where all of it shows an image that is not blurred,
  std::vector<std::uint8_t> glossy;     // and one that is
  double holes = 0;                     // share of the reflected images' pixels that were filled from beside
  std::vector<std::uint8_t> movers{};   // by pixel: 1 where all of it shows an object that moves; empty: none
};

// Over the whole frame, over the pixels that show reflected images, or those that show movers.
struct RegionComparison {
  std::string name;  // frame, reflectors, mirrors, glossy, movers; matte: all else
  std::size_t pixels = 0;
  RelativeError total, diffuse;
  std::optional<RelativeError> specular;  // of reflectors: the player's S is not apart elsewhere
  double mse = 0, noise_mse = 0;          // mean square of the difference of what is shown; what noise alone makes
  double ssim = 0, flip = 0;              // means
};

struct Comparison {
  std::uint32_t width = 0, height = 0;
  float white = 1;                        // cd/m² shown as white in both
  double holes = 0;                       // as PlayedFrame
  std::vector<RegionComparison> regions;  // the frame first; regions without pixels are left out
  FloatImage picture;                     // reference, frame, FLIP (white is 1), side by side, sRGB in [0, 1]
};

// white: 0 takes the reference's log-average luminance for middle grey. Errors: kInvalid where the reference is not
// of the frame's size, lacks a layer of `oriel-bake render` or holds values that are not finite; kDifferent where the
// frame holds such.
Result<Comparison> compare(const PlayedFrame& frame, const LayeredImage& reference, float white);

// A table for people; and the same as JSON, with whether the frame's FLIP is within max_flip, where there is one.
std::string comparison_text(const Comparison& comparison);
std::string comparison_json(const Comparison& comparison, std::optional<double> max_flip = {});

}  // namespace oriel
