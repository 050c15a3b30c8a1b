// Measures of pictures: values that can be derived, and that each of them sees a difference at all.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "formats/core/vec.h"
#include "formats/image/contrast_sensitivity.h"
#include "formats/image/display.h"
#include "formats/image/filter.h"
#include "formats/image/flip.h"
#include "formats/image/relative_error.h"
#include "formats/image/ssim.h"
#include "formats/image/visible.h"

namespace oriel {
namespace {

constexpr std::uint32_t kSide = 48;

template <class Color>
FloatImage picture(const Color& color, std::uint32_t side = kSide) {
  FloatImage image{side, side, 3, {}};
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x) {
      const Vec3 c = color(x, y);
      image.pixels.insert(image.pixels.end(), {c.r, c.g, c.b});
    }
  return image;
}

FloatImage plain(const Vec3& color) {
  return picture([&](auto, auto) { return color; });
}

// Waves of several directions and colours, in [0, 1].
FloatImage waves(float phase = 0) {
  return picture([=](std::uint32_t x, std::uint32_t y) {
    const auto fx = static_cast<float>(x), fy = static_cast<float>(y);
    return Vec3(0.5f + 0.5f * std::sin(0.7f * fx + 0.2f * fy + phase), 0.5f + 0.4f * std::sin(0.15f * fx * fy / 20),
                0.3f + 0.3f * std::cos(0.9f * fy - phase));
  });
}

FloatImage blurred(const FloatImage& image, double sigma) {
  FloatImage out = image;
  for (std::size_t c = 0; c < 3; ++c) {
    Plane plane{static_cast<int>(image.width), static_cast<int>(image.height), {}};
    for (std::size_t i = c; i < image.pixels.size(); i += 3) plane.values.push_back(image.pixels[i]);
    const auto kernel = gaussian(sigma, 8);
    plane = filtered(plane, kernel, kernel);
    for (std::size_t i = 0; i < plane.values.size(); ++i) out.pixels[3 * i + c] = plane.values[i];
  }
  return out;
}

double flip(const FloatImage& a, const FloatImage& b) {
  return mean_over(flip_map(a, b));
}

double ssim(const FloatImage& a, const FloatImage& b) {
  return mean_over(ssim_map(a, b));
}

TEST(RelativeError, SeesADarkerFrame) {
  const RelativeError e = *relative_error(plain(Vec3(1.8f)), plain(Vec3(2)));
  EXPECT_NEAR(e.rel_rmse, 0.1 / std::sqrt(1 + 1e-4), 1e-6);
  EXPECT_NEAR(e.n_rmse, 0.1, 1e-6);
  EXPECT_NEAR(e.bias, -0.1, 1e-6);
  EXPECT_EQ(e.noise, 0);
  EXPECT_EQ(relative_error(plain(Vec3(2)), plain(Vec3(2)))->rel_rmse, 0);
}

TEST(RelativeError, ItsOwnNoiseLeavesNothing) {
  const FloatImage reference = plain(Vec3(1, 2, 3)), noise = plain(Vec3(0.1f, 0.2f, 0.3f));
  FloatImage frame = reference;
  for (std::size_t i = 0; i < frame.pixels.size(); ++i)
    frame.pixels[i] += (i % 2 == 0 ? 1.0f : -1.0f) * noise.pixels[i];
  const RelativeError e = *relative_error(frame, reference, noise);
  EXPECT_NEAR(e.noise, e.rel_rmse, 1e-7);
  EXPECT_LT(e.net(), 1e-3);
}

TEST(RelativeError, CountsTheRegionOnly) {
  FloatImage frame = plain(Vec3(2));
  frame.pixels[0] = 1e6f;
  std::vector<std::uint8_t> region(kSide * kSide, 1);
  region[0] = 0;
  EXPECT_EQ(relative_error(frame, plain(Vec3(2)), {}, region)->rel_rmse, 0);
  EXPECT_GT(relative_error(frame, plain(Vec3(2)))->rel_rmse, 1);
}

TEST(RelativeError, BlackAndMisshapenPictures) {
  EXPECT_EQ(relative_error(plain(Vec3(0)), plain(Vec3(0)))->rel_rmse, 0);
  EXPECT_TRUE(std::isinf(relative_error(plain(Vec3(1)), plain(Vec3(0)))->net())) << "light where there is none";
  std::vector<std::uint8_t> none(kSide * kSide, 0);
  EXPECT_EQ(relative_error(plain(Vec3(1)), plain(Vec3(2)), {}, none)->rel_rmse, 0);
  EXPECT_EQ(relative_error({2, 2, 3, std::vector<float>(12)}, plain(Vec3(0))).error().code, ErrorCode::kInvalid);
}

TEST(RelativeError, NotANumberIsNeverNone) {
  FloatImage broken = plain(Vec3(2));
  broken.pixels[100] = std::numeric_limits<float>::quiet_NaN();
  for (const auto& e : {relative_error(broken, plain(Vec3(2))), relative_error(plain(Vec3(2)), broken)}) {
    EXPECT_TRUE(std::isnan(e->rel_rmse));
    EXPECT_TRUE(std::isnan(e->net()));
  }
}

TEST(Shrink, AveragesSquares) {
  const FloatImage ramp = picture([](std::uint32_t x, std::uint32_t y) { return Vec3(x, y, 1); });
  const FloatImage half = shrink(ramp, 2);
  ASSERT_EQ(half.width, kSide / 2);
  EXPECT_FLOAT_EQ(half.pixels[(5 * half.width + 3) * 3], 6.5f);
  EXPECT_FLOAT_EQ(half.pixels[(5 * half.width + 3) * 3 + 1], 10.5f);
  EXPECT_FLOAT_EQ(half.pixels[(5 * half.width + 3) * 3 + 2], 1);
}

TEST(Shown, MiddleGreyIsAtItsPlace) {
  FloatImage light = plain(Vec3(40));
  for (std::size_t i = 0; i < 300; ++i) light.pixels[i] = 0;  // unlit pixels do not count
  EXPECT_NEAR(white_of(light), 40 / 0.18, 1e-3);
  EXPECT_NEAR(shown(light, white_of(light)).pixels.back(), 0.4613561, 1e-5);  // sRGB of 0.18
  EXPECT_EQ(shown(plain(Vec3(-1, 1e30f, 0)), 1).pixels[0], 0);
  EXPECT_NEAR(shown(plain(Vec3(-1, 1e30f, 0)), 1).pixels[1], 1, 1e-6);
  EXPECT_EQ(white_of(plain(Vec3(0))), 1);
}

double psnr(const FloatImage& a, const FloatImage& b) {
  return psnr_db(mean_over(squared_difference(a, b)));
}

TEST(Psnr, IsTheLogarithmOfTheSquares) {
  EXPECT_EQ(psnr(waves(), waves()), 99);
  EXPECT_NEAR(psnr(plain(Vec3(0)), plain(Vec3(1))), 0, 1e-9);
  EXPECT_NEAR(psnr(plain(Vec3(0.5f)), plain(Vec3(0.6f))), 20, 1e-5);
}

// Near middle grey a small error of light moves its sRGB value by the curve's slope, 1.055 / 2.4 · 0.18^(1/2.4 - 1).
TEST(Shown, CarriesNoiseAlongTheCurve) {
  const double slope = 1.055 / 2.4 * std::pow(0.18, 1 / 2.4 - 1);
  const FloatImage variance = shown_variance(plain(Vec3(0.18f)), plain(Vec3(0.01f)), 1);
  EXPECT_NEAR(std::sqrt(mean_over(variance)), 0.01 * slope, 0.01 * 0.01 * slope);
}

// Two even pictures have no variance: what is left is the comparison of their means.
TEST(Ssim, OfEvenPicturesComparesTheirMeans) {
  EXPECT_NEAR(ssim(waves(), waves()), 1, 1e-6);
  EXPECT_NEAR(ssim(plain(Vec3(0.25f)), plain(Vec3(0.5f))), (2 * 0.125 + 1e-4) / (0.0625 + 0.25 + 1e-4), 1e-4);
}

TEST(Ssim, IsSymmetricAndFallsWithBlurAndSign) {
  EXPECT_DOUBLE_EQ(ssim(waves(), waves(1)), ssim(waves(1), waves()));
  EXPECT_GT(ssim(waves(), blurred(waves(), 0.5)), ssim(waves(), blurred(waves(), 1)));
  EXPECT_GT(ssim(waves(), blurred(waves(), 1)), ssim(waves(), blurred(waves(), 3)));
  FloatImage inverse = waves();
  for (float& v : inverse.pixels) v = 1 - v;
  EXPECT_LT(ssim(waves(), inverse), 0);
}

// The largest difference that the paper's scale knows is green to blue, by definition 1. Black to white has HyAB 100 of
// 203.28 there, which its knee maps to 0.95 + 0.05 (0.6087 - 0.4) / 0.6 with 0.6087 = (100 / 203.28)^0.7.
TEST(Flip, OfEvenPicturesIsTheirColorError) {
  EXPECT_EQ(flip(waves(), waves()), 0);
  EXPECT_NEAR(flip(plain({0, 1, 0}), plain({0, 0, 1})), 1, 1e-4);
  EXPECT_NEAR(flip(plain(Vec3(0)), plain(Vec3(1))), 0.96739, 1e-4);
  // Below the knee the scale is a line: L* of sRGB 0.5 and 0.55 are 53.389 and 58.289; 0.95 / 0.4 (4.9 / 203.28)^0.7.
  EXPECT_NEAR(flip(plain(Vec3(0.5f)), plain(Vec3(0.55f))), 0.95 / 0.4 * std::pow(4.9 / 203.28, 0.7), 2e-3);
}

TEST(Flip, IsSymmetricAndGrowsWithBlur) {
  EXPECT_NEAR(flip(waves(), waves(1)), flip(waves(1), waves()), 1e-6);
  double before = 0;
  for (const double sigma : {0.5, 1.0, 2.0, 4.0}) {
    const double now = flip(waves(), blurred(waves(), sigma));
    EXPECT_GT(now, before) << sigma;
    before = now;
  }
}

// The eye sees less of a fine pattern from farther away.
TEST(Flip, FallsWithDistance) {
  const auto checks = [](std::uint32_t inverse) {
    return picture([=](std::uint32_t x, std::uint32_t y) { return Vec3((x + y + inverse) % 2 == 0 ? 1.0f : 0.0f); });
  };
  const double near = mean_over(flip_map(checks(0), checks(1), 10)),
               far = mean_over(flip_map(checks(0), checks(1), 90));
  EXPECT_LT(far, near);
}

TEST(Flip, OfOnePixel) {
  const FloatImage black{1, 1, 3, {0, 0, 0}}, white{1, 1, 3, {1, 1, 1}};
  EXPECT_NEAR(flip(black, white), 0.96739, 1e-4);
}

// A grating on a plain wall: its contrast over the threshold. Octaves overlap, so that one in the middle of one has a
// part of its contrast in both beside it.
TEST(Visible, OfAGratingIsItsContrastOverTheThreshold) {
  constexpr std::uint32_t kWide = 256;
  constexpr double kPixelsPerDegree = 32;
  for (const int octave : {1, 2, 3}) {
    const double cycles = std::sqrt(0.125) / std::exp2(octave);  // a pixel
    const double threshold = 1 / contrast_sensitivity(cycles * kPixelsPerDegree);
    const auto wall = picture([](auto, auto) { return Vec3(0.5f); }, kWide);
    const auto striped = [&](double contrast) {
      return picture(
          [&](std::uint32_t x, auto) {
            return Vec3(static_cast<float>(0.5 + 0.51 * contrast * std::sin(2 * kPiD * cycles * x)));
          },
          kWide);
    };
    const double once = visible_error(wall, striped(threshold), 1, kPixelsPerDegree).rms;
    EXPECT_GT(once, 0.6) << octave;
    EXPECT_LT(once, 1.2) << octave;
    EXPECT_NEAR(visible_error(wall, striped(3 * threshold), 1, kPixelsPerDegree).rms, 3 * once, 0.01 * once);
  }
}

TEST(Visible, IsNothingOfEqualFramesAndLessWhereTheReferenceIsRough) {
  const FloatImage rough = waves();
  EXPECT_EQ(visible_error(rough, rough, 1).rms, 0);
  EXPECT_EQ(visible_error(rough, rough, 1).share, 0);
  const auto with = [](FloatImage image, const FloatImage& grain) {
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = 0.8f * image.pixels[i] + grain.pixels[i];
    return image;
  };
  const auto grain = [](float of) {
    return picture([=](std::uint32_t x, std::uint32_t y) { return Vec3((x * 7 + y * 13) % 5 < 2 ? of : 0.0f); });
  };
  const double on_rough = visible_error(with(rough, grain(0)), with(rough, grain(0.02f)), 1).rms;
  const double on_plain =
      visible_error(with(plain(Vec3(0.5f)), grain(0)), with(plain(Vec3(0.5f)), grain(0.02f)), 1).rms;
  EXPECT_GT(on_plain, 1);
  EXPECT_LT(on_rough, 0.5 * on_plain);
}

// What a display cannot show nobody sees, and a black frame divides by nothing.
TEST(Visible, EndsAtWhiteAndAtBlack) {
  EXPECT_EQ(visible_error(plain(Vec3(2)), plain(Vec3(3)), 1).rms, 0);
  EXPECT_TRUE(std::isfinite(visible_error(plain(Vec3(0)), waves(), 1).rms));
  EXPECT_EQ(visible_error(plain(Vec3(0)), plain(Vec3(0)), 1).rms, 0);
}

}  // namespace
}  // namespace oriel
