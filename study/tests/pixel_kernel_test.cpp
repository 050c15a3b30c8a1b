// K as one kernel of pixels.
#include "study/bastos1999/pixel_kernel.h"

#include <gtest/gtest.h>

#include <numeric>

namespace oriel::study {
namespace {

BrdfKernel kernel_of(std::uint32_t size, float half_extent) {
  BrdfKernel kernel;
  kernel.size = size;
  kernel.half_extent = half_extent;
  kernel.weights.clear();
  double sum = 0;
  for (std::uint32_t i = 0; i < size * size; ++i) {
    const Vec2 t = (Vec2(i % size, i / size) + 0.5f) / static_cast<float>(size) * 2.0f - 1.0f;
    kernel.weights.push_back(std::exp(-3 * glm::dot(t, t)));
    sum += kernel.weights.back();
  }
  for (float& w : kernel.weights) w = static_cast<float>(w / sum);
  return kernel;
}

TEST(PixelKernel, OfAsManyPixelsIsTheKernel) {
  const BrdfKernel kernel = kernel_of(9, 0.4f);
  const PixelKernel same = make_pixel_kernel(kernel, 4.5f / 0.4f);
  ASSERT_EQ(same.radius, 4);
  for (std::size_t i = 0; i < 81; ++i) EXPECT_NEAR(same.weights[i], kernel.weights[i], 1e-6);
  const PixelKernel third = make_pixel_kernel(kernel, 1.5f / 0.4f);
  ASSERT_EQ(third.radius, 1);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 3; ++x) {
      double sum = 0;
      for (int k = 0; k < 9; ++k)
        sum += double{kernel.weights[static_cast<std::size_t>((3 * y + k / 3) * 9 + 3 * x + k % 3)]};
      EXPECT_NEAR(third.weights[static_cast<std::size_t>(3 * y + x)], sum, 1e-6);
    }
}

// Its second moment is the kernel's and that of a pixel, at any scale.
TEST(PixelKernel, KeepsItsLightAndItsWidth) {
  const BrdfKernel kernel = kernel_of(31, 0.7f);
  for (const float pixels : {0.2f, 1.0f, 3.7f, 10.0f, 31.0f}) {
    const PixelKernel made = make_pixel_kernel(kernel, pixels / 0.7f);
    const int side = 2 * made.radius + 1;
    EXPECT_NEAR(std::accumulate(made.weights.begin(), made.weights.end(), 0.0), 1, 1e-5);
    double width = 0, expected = 0;
    for (int i = 0; i < side * side; ++i)
      width += double{made.weights[static_cast<std::size_t>(i)]} * std::pow(i % side - made.radius, 2);
    for (std::size_t i = 0; i < kernel.weights.size(); ++i)
      expected += double{kernel.weights[i]} * std::pow((i % 31 + 0.5 - 15.5) / 15.5 * pixels, 2);
    EXPECT_NEAR(std::sqrt(width), std::sqrt(expected), 0.3) << pixels;
    EXPECT_LE(choose_reduction(kernel, pixels / 0.7f), 8);
  }
  EXPECT_EQ(make_pixel_kernel({}, 100).radius, 0) << "a mirror";
  EXPECT_EQ(choose_reduction({}, 100), 1);
  EXPECT_EQ(choose_reduction(kernel, 5.5f / 0.7f), 1);
  EXPECT_EQ(choose_reduction(kernel, 5.6f / 0.7f), 2);
}

}  // namespace
}  // namespace oriel::study
