// Frames beside an earlier one of oriel-play, in numbers and as a picture.
#pragma once

#include <optional>
#include <string>

#include "formats/core/result.h"
#include "formats/image/image.h"
#include "formats/image/visible.h"

namespace oriel {

struct PictureDifference {
  std::uint32_t width = 0, height = 0;
  std::size_t changed = 0;          // pixels with a value that is not the same
  double largest = 0;               // difference of two values: cd/m² of linear pictures, [0, 1] of pictures as shown
  double flip = 0, worst_flip = 0;  // mean and largest over the pixels
  std::optional<VisibleError> visible;  // of linear pictures
  FloatImage picture;                   // FLIP by pixel, one channel
};

// Pictures of one size, three channels: linear light, which is shown with `white` (cd/m²) as white, or, where white is
// 0, sRGB-encoded in [0, 1] already. Errors: kInvalid where the sizes differ, kDifferent where the frame has values
// that are not finite.
Result<PictureDifference> difference(const FloatImage& reference, const FloatImage& frame, float white);

// max_flip: of the mean.
std::string difference_text(const PictureDifference& difference);
std::string difference_json(const PictureDifference& difference, std::optional<double> max_flip);

}  // namespace oriel
