// Directions to a sky image in proportion to its luminance.
#pragma once

#include "bake/scene/sky.h"

namespace oriel {

// The grid of cells between texel centres, which is what bilinear lookup interpolates over: a cell by inversion of the
// cumulative sums (marginal over rows, then along the row), a point in it in proportion to the luminance interpolated
// between its corners. Inversion keeps stratified points stratified. The density is then that of the radiance itself,
// up to interpolating in the cosine of the polar angle instead of the angle.
class SkySampler {
 public:
  SkySampler() = default;
  explicit SkySampler(const SkyImage& image);  // kept by reference

  bool empty() const { return rows_.empty(); }  // no image, or a black one

  struct Sample {
    Vec3 direction{0, 1, 0};
    float pdf = 0;  // per steradian
  };
  Sample sample(const Vec2& v) const;
  float pdf(const Vec3& direction) const;

 private:
  struct Corners {
    double upper_left, upper_right, lower_left, lower_right;  // luminance
  };
  Corners corners(const SkyRow& row, std::uint32_t x) const;

  const SkyImage* image_ = nullptr;
  std::vector<double> rows_;  // cumulative ∫ luminance dω over rows; the last is the whole sky's
  std::vector<float> cells_;  // cumulative share along each row; row-major, image width a row
};

}  // namespace oriel
