// CIE standard skies.
#include <gtest/gtest.h>

#include "formats/core/daylight.h"
#include "scenes/sky.h"

namespace oriel::sample {
namespace {

// Level illuminance from the image's upper or lower half.
double illuminance(const FloatImage& image, bool upper) {
  double sum = 0;
  for (std::uint32_t y = 0; y < image.height; ++y)
    for (std::uint32_t x = 0; x < image.width; ++x) {
      const double theta = kPiD * (y + 0.5) / image.height;
      if ((std::cos(theta) > 0) != upper) continue;
      sum += image.pixels[(std::size_t{y} * image.width + x) * 3] * std::abs(std::cos(theta)) * std::sin(theta) *
             (kPiD / image.height) * (2 * kPiD / image.width);
    }
  return sum;
}

TEST(CieSky, EveryTypeShedsTheIlluminanceAskedFor) {
  for (int type = 1; type <= 16; ++type)
    for (const double elevation : {0.0, 20.0, 60.0, 90.0}) {
      const auto image = make_sky({.type = type, .elevation_deg = elevation, .ground = 0.3, .height = 256});
      ASSERT_TRUE(image) << image.error().text();
      EXPECT_NEAR(illuminance(*image, true), 1e4, 5) << "type " << type << ", sun at " << elevation;
      EXPECT_NEAR(illuminance(*image, false), 0.3e4, 1);
    }
}

TEST(CieSky, KnownLuminances) {
  const double horizon = kPiD / 2, sun = 0.5;
  EXPECT_NEAR(relative_sky_luminance(1, horizon, sun, 1), 1 / (1 + 4 * std::exp(-0.7)), 1e-9);
  EXPECT_NEAR(relative_sky_luminance(16, horizon, sun, 1), 1.0 / 3, 1e-12);
  for (const double angle : {0.0, 0.4, 1.2}) EXPECT_DOUBLE_EQ(relative_sky_luminance(5, angle, sun, 1), 1);
  for (int type = 1; type <= 16; ++type) EXPECT_NEAR(relative_sky_luminance(type, 0, sun, sun), 1, 1e-12);
  const auto uniform = make_sky({.type = 5, .zenith_cd_m2 = 700, .ground = 0, .height = 16});
  EXPECT_FLOAT_EQ(uniform->pixels[0], 700);
  EXPECT_EQ(uniform->pixels.back(), 0);
}

TEST(CieSky, TheSunStandsWhereItIsAskedFor) {
  // Clear sky, sun in the east: +X is the image's centre. In the south, +Z: a quarter to its right.
  for (const auto& [azimuth, column] : {std::pair{90.0, 128u}, {180.0, 192u}, {0.0, 64u}}) {
    const auto image = make_sky({.type = 12, .elevation_deg = 30, .azimuth_deg = azimuth, .height = 128});
    std::size_t brightest = 0;
    for (std::size_t i = 0; i < image->pixels.size(); i += 3)
      if (image->pixels[i] > image->pixels[brightest]) brightest = i;
    const std::size_t x = brightest / 3 % image->width, y = brightest / 3 / image->width;
    EXPECT_NEAR(double(x), column - 0.5, 1);
    EXPECT_NEAR(double(y), 128 * 60.0 / 180 - 0.5, 1);
  }
}

TEST(CieSky, RefusesWhatIsOutOfRange) {
  for (const SkyOptions& o :
       {SkyOptions{.type = 0}, SkyOptions{.type = 17}, SkyOptions{.elevation_deg = -1},
        SkyOptions{.elevation_deg = NAN}, SkyOptions{.azimuth_deg = 1000}, SkyOptions{.horizontal_lux = -1},
        SkyOptions{.zenith_cd_m2 = INFINITY}, SkyOptions{.ground = 1.1}, SkyOptions{.height = 1}}) {
    const auto image = make_sky(o);
    ASSERT_FALSE(image);
    EXPECT_EQ(image.error().code, ErrorCode::kUsage);
  }
}

}  // namespace
}  // namespace oriel::sample
