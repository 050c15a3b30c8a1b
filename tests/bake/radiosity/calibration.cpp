#include "tests/bake/radiosity/calibration.h"

namespace oriel::test {
namespace {

// The truth is the reference estimator, which shares no code of the gather, the cache or the filter. Its own noise, as
// it states it, is taken off the squared error and added to the interval.
Baked converged(const Scene& scene, const CalibrationOptions& settings) {
  RadiosityOptions paths;
  paths.samples = settings.truth_samples;
  paths.dilation = 0;
  paths.stitch = false;
  return bake(scene, settings.texel_m, paths, 0, 0);  // a seed of its own
}

DVec3 mean_light(const Baked& truth) {
  DVec3 sum(0);
  double texels = 0;
  truth.each_texel(
      [&](const LightmapPage& page, std::uint32_t t, std::uint32_t) { sum += DVec3(page.irradiance[t]), ++texels; });
  return sum / std::max(1.0, texels);
}

}  // namespace

Calibration calibrate(const Scene& scene, const CalibrationOptions& settings) {
  const Baked truth = converged(scene, settings);
  const DVec3 mean = mean_light(truth);
  Calibration c;
  double count = 0, light = 0;
  for (int seed = 1; seed <= settings.bakes; ++seed) {
    const Baked b = bake(scene, settings.texel_m, settings.cached, 0, static_cast<std::uint64_t>(seed));
    c.stated += std::pow(b.radiosity.report.relative_error, 2) / settings.bakes;
    truth.each_texel([&](const LightmapPage& page, std::uint32_t t, std::uint32_t) {
      const LightmapPage& ours = b.radiosity.pages[static_cast<std::size_t>(&page - truth.radiosity.pages.data())];
      if (ours.state[t] != TexelState::kValid) return;
      for (int k = 0; k < 3; ++k) {
        const double value = page.irradiance[t][k], off = ours.irradiance[t][k] - value;
        const double noise2 = std::pow(page.standard_error[t][k], 2);
        const double scale2 = value * value + std::pow(0.01 * mean[k], 2);
        c.covered +=
            std::abs(off) <= 1.96 * std::sqrt(std::pow(settings.claimed * ours.standard_error[t][k], 2) + noise2);
        c.error += (off * off - noise2) / scale2;
        c.truth += noise2 / scale2;
        c.bias += off, light += value, ++count;
      }
    });
  }
  c.covered /= count;
  c.error = std::sqrt(std::max(0.0, c.error / count));
  c.stated = std::sqrt(c.stated);
  c.truth = std::sqrt(c.truth / count);
  c.bias /= light;
  return c;
}

}  // namespace oriel::test
