// Errors asked for, stated and met in small rooms.
// Usage: calibration_bench [--error E | --rays N] [--bakes N] [--texel M] [--truth-samples N] [--no-filter]
#include <CLI/CLI.hpp>
#include <cstdio>
#include <sstream>

#include "tests/bake/radiosity/calibration.h"
#include "tests/bake/radiosity/rooms.h"

namespace oriel::test {
namespace {

int run(int argc, char** argv) {
  CalibrationOptions settings;
  RadiosityOptions& o = settings.cached;
  std::uint32_t rays = 0;
  bool no_filter = false;
  CLI::App app("Coverage of stated errors, and errors asked for against errors met.");
  app.add_option("--error", o.error, "relative error asked for")->check(CLI::PositiveNumber);
  app.add_option("--rays", rays, "gather rays a texel, in place of an error");
  app.add_option("--bakes", settings.bakes, "seeds")->check(CLI::PositiveNumber);
  app.add_option("--texel", settings.texel_m, "metres")->check(CLI::PositiveNumber);
  app.add_option("--truth-samples", settings.truth_samples, "paths a pixel")->check(CLI::PositiveNumber);
  app.add_flag("--no-filter", no_filter, "gathered light as it is");
  CLI11_PARSE(app, argc, argv);
  if (rays > 0) o.samples = rays, o.error = 0;
  if (no_filter) o.filter.strength = 0;
  std::printf("| room | covered by 1.96 errors | error | stated | bias | of the truth |\n|---|---|---|---|---|---|\n");
  for (const Feature f : {Feature::kMatt, Feature::kDielectric, Feature::kSky, Feature::kPoint, Feature::kGlossyFloor,
                          Feature::kSphere}) {
    const Calibration c = calibrate(room(f), settings);
    std::ostringstream name;
    name << f;
    std::printf("| %s | %.1f %% | %.2f %% | %.2f %% | %+.2f %% | %.2f %% |\n", name.str().c_str(), 100 * c.covered,
                100 * c.error, 100 * c.stated, 100 * c.bias, 100 * c.truth);
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace
}  // namespace oriel::test

int main(int argc, char** argv) {
  return oriel::test::run(argc, argv);
}
