// Frames in radiance: how far one is from a path-traced reference, whose own noise is told apart.
#pragma once

#include "formats/core/result.h"
#include "formats/image/region.h"

namespace oriel {

struct RelativeError {
  double rel_rmse = 0;  // root of the mean of |x - r|² / (r² + (0.01 mean r)²) over pixels and channels
  double noise = 0;     // the same of the reference's standard error
  double n_rmse = 0;    // root of the mean of |x - r|² over the mean of r
  double bias = 0;      // mean x / mean r - 1, over all channels
  double net() const;   // rel_rmse with the noise removed in quadrature
};

// Pictures of three channels and one size, linear; noise: the reference's standard error, or an empty picture where it
// has none. Means are those of the region, by channel. What is 0 in a reference of 0 does not count. Where the
// reference is black all numbers are 0 if the frame is black too, else its errors are infinite. NaN gives NaN. Error
// kInvalid for shapes that differ.
Result<RelativeError> relative_error(const FloatImage& frame, const FloatImage& reference, const FloatImage& noise = {},
                                     const Region& region = {});

// Means over n × n pixels; sides that n does not divide lose their rest.
FloatImage shrink(const FloatImage& image, std::uint32_t n);

}  // namespace oriel
