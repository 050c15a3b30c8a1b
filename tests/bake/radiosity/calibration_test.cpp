// Stated errors hold the truth as often as they say, and the error asked for is the error met.
#include "tests/bake/radiosity/calibration.h"

#include <gtest/gtest.h>

#include "tests/bake/radiosity/rooms.h"

namespace oriel::test {
namespace {

class Calibrated : public ::testing::TestWithParam<Feature> {};

TEST_P(Calibrated, IntervalsHoldTheTruthAndTheErrorAskedForIsMet) {
  CalibrationOptions settings;
  settings.texel_m = 0.06f;  // where less is hidden in texels than was asked for
  settings.bakes = 2;
  settings.cached.error = 0.03;  // less than the first few rays reach by themselves
  settings.truth_samples = 2048;
  const Calibration c = calibrate(room(GetParam()), settings);
  EXPECT_GE(c.covered, 0.90);
  EXPECT_LE(c.covered, 0.99);
  // Interpolation leaves down to four ninths of the square of noise that texels state, and scenes that the first few
  // rays tell better than asked are left at that.
  EXPECT_LE(c.error, 1.25 * settings.cached.error);
  EXPECT_GE(c.error, 0.4 * c.stated);
}

INSTANTIATE_TEST_SUITE_P(Rooms, Calibrated,
                         ::testing::Values(Feature::kMatt, Feature::kDielectric, Feature::kSky, Feature::kPoint,
                                           Feature::kSphere));

// The checker itself: intervals of less than half the width are found out.
TEST(Calibration, TooNarrowIntervalsAreFoundOut) {
  CalibrationOptions settings;
  settings.texel_m = 0.1f;
  settings.bakes = 2;
  settings.truth_samples = 2048;
  settings.claimed = 0.4;
  EXPECT_LT(calibrate(room(Feature::kMatt), settings).covered, 0.90);
}

}  // namespace
}  // namespace oriel::test
