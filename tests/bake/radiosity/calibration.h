// Do stated errors tell the truth? Pixels of bakes with different seeds beside converged unbiased paths.
#pragma once

#include "tests/bake/radiosity/baked.h"

namespace oriel::test {

struct CalibrationOptions {
  RadiosityOptions cached;
  std::uint32_t truth_samples = 4096;  // paths a pixel
  std::uint32_t pixels = 2048;         // about
  float texel_m = 0.2f;
  int bakes = 6;
  double claimed = 1;  // share of the stated errors that is taken for them: below 1, a liar

  CalibrationOptions() {
    cached.estimator = Estimator::kCached;
    cached.samples = 4096;
    cached.error = 0.05;
  }
};

struct Calibration {
  double covered = 0;  // share of pixels and channels whose 95 % interval holds the truth
  double error = 0;    // measured, as RadiosityOptions::error has it
  double stated = 0;   // RadiosityReport::relative_error, rms over the bakes
  double truth = 0;    // the truth's own error
  double bias = 0;     // of the mean light of all bakes, relative
};

Calibration calibrate(const Scene& scene, const CalibrationOptions& settings);

}  // namespace oriel::test
