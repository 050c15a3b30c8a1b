// Errors asked for, stated and met in small rooms.
// Usage: calibration_bench [--error E | --rays N] [--bakes N] [--texel M] [--truth-samples N] [--no-filter]
#include <cstdio>
#include <sstream>

#include "formats/cli/command.h"
#include "tests/bake/radiosity/calibration.h"
#include "tests/bake/radiosity/rooms.h"

namespace oriel::test {
namespace {

int run(int argc, char** argv) {
  CalibrationOptions settings;
  RadiosityOptions& o = settings.cached;
  std::uint32_t rays = 0;
  bool no_filter = false;
  if (const auto code =
          parse_options(argc, argv, "Coverage of stated errors, and errors asked for against errors met.",
                        {{"--error", "Options", "Relative error asked for", number(o.error, 1e-9, 1e9)},
                         {"--rays", "Options", "Gather rays a texel, in place of an error", number(rays, 0, 1e9)},
                         {"--bakes", "Options", "Seeds", number(settings.bakes, 1, 1e9)},
                         {"--texel", "Options", "Metres", number(settings.texel_m, 1e-9, 1e9)},
                         {"--truth-samples", "Options", "Paths a pixel", number(settings.truth_samples, 1, 1e9)},
                         {"--no-filter", "Options", "Gathered light as it is", flag(no_filter)}}))
    return *code;
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
