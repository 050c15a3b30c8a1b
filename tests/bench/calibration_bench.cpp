// Do stated errors tell the truth? Bakes of small rooms with different seeds against converged unbiased paths.
// Usage: calibration_bench [--error E | --rays N] [--bakes N] [--texel M] [--truth-samples N] [--no-filter]
#include <CLI/CLI.hpp>
#include <cstdio>
#include <sstream>
#include <map>
#include <algorithm>

#include "tests/bake/radiosity/baked.h"
#include "tests/bake/radiosity/rooms.h"

namespace oriel::test {
namespace {

struct Settings {
  RadiosityOptions cached;
  std::uint32_t truth_samples = 4096;
  float texel_m = 0.2f;
  int bakes = 6;
};

struct Calibration {
  double covered = 0;  // share of texels and channels whose 95 % interval holds the truth
  double error = 0;    // measured, as RadiosityOptions::error has it
  double stated = 0;   // RadiosityReport::relative_error, rms over the bakes
  double truth = 0;    // the truth's own error
  double bias = 0;     // of the mean light of all bakes, relative
};

// The truth is the reference estimator, which shares no code of the gather, the cache or the filter. Its own noise, as
// it states it, is taken off the squared error and added to the interval.
Baked converged(const Scene& scene, const Settings& settings) {
  RadiosityOptions paths;
  paths.samples = settings.truth_samples;
  paths.dilation = 0;
  paths.stitch = false;
  return bake(scene, settings.texel_m, paths);
}

DVec3 mean_light(const Baked& truth) {
  DVec3 sum(0);
  double texels = 0;
  truth.each_texel(
      [&](const LightmapPage& page, std::uint32_t t, std::uint32_t) { sum += DVec3(page.irradiance[t]), ++texels; });
  return sum / std::max(1.0, texels);
}

Calibration measure(const Scene& scene, const Settings& settings) {
  const Baked truth = converged(scene, settings);
  const DVec3 mean = mean_light(truth);
  Calibration c;
  double count = 0, light = 0; std::map<std::pair<int,int>, std::array<double,5>> dbg;
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
        c.covered += std::abs(off) <= 1.96 * std::sqrt(std::pow(ours.standard_error[t][k], 2) + noise2);
        c.error += (off * off - noise2) / scale2;
        c.truth += noise2 / scale2;
        c.bias += off, light += value, ++count;
        if (k == 1) { auto& d = dbg[{(int)(&page - truth.radiosity.pages.data()), (int)t}]; d[0] += off*off/scale2/settings.bakes; d[1] += std::pow(ours.standard_error[t][k],2)/scale2/settings.bakes; d[2] = value; d[3] += off/settings.bakes; d[4] = noise2/scale2; }
      }
    });
  }
  if (getenv("DBG")) { std::vector<std::pair<double,std::pair<int,int>>> o; for (auto& [k,d] : dbg) o.push_back({d[0],k}); std::sort(o.rbegin(), o.rend());
    double tot=0; for (auto& x : o) tot += x.first; std::printf("texels %zu total %.4f\n", o.size(), tot/o.size());
    for (int i = 0; i < atoi(getenv("DBG")); ++i) { auto& d = dbg[o[i].second]; const auto& pg = truth.radiosity.pages[o[i].second.first]; std::printf("p%d x%d y%d share %.3f rms %.3f stated %.3f value %.2f bias %.3f truth %.3f vis %.2f\n", o[i].second.first, o[i].second.second % (int)pg.width, o[i].second.second / (int)pg.width, d[0]/tot, std::sqrt(d[0]), std::sqrt(d[1]), d[2], d[3]/d[2], std::sqrt(d[4]), 0.0); } }
  c.covered /= count;
  c.error = std::sqrt(std::max(0.0, c.error / count));
  c.stated = std::sqrt(c.stated);
  c.truth = std::sqrt(c.truth / count);
  c.bias /= light;
  return c;
}

int run(int argc, char** argv) {
  Settings settings;
  RadiosityOptions& o = settings.cached;
  o.estimator = Estimator::kCached;
  o.samples = 4096;
  o.error = 0.05;
  o.dilation = 0;
  o.stitch = false;
  std::uint32_t rays = 0;
  bool no_filter = false;
  CLI::App app("Coverage of stated errors, and errors asked for against errors met.");
  app.add_option("--error", o.error, "relative error asked for")->check(CLI::PositiveNumber);
  app.add_option("--rays", rays, "gather rays a texel, in place of an error");
  app.add_option("--bakes", settings.bakes, "seeds")->check(CLI::PositiveNumber);
  app.add_option("--texel", settings.texel_m, "metres")->check(CLI::PositiveNumber);
  app.add_option("--truth-samples", settings.truth_samples, "paths a texel")->check(CLI::PositiveNumber);
  app.add_flag("--no-filter", no_filter, "gathered light as it is");
  CLI11_PARSE(app, argc, argv);
  if (rays > 0) o.samples = rays, o.error = 0;
  if (no_filter) o.filter.strength = 0;
  std::printf("| room | covered by 1.96 errors | error | stated | bias | of the truth |\n|---|---|---|---|---|---|\n");
  for (const Feature f : {Feature::kMatt, Feature::kDielectric, Feature::kSky, Feature::kPoint, Feature::kGlossyFloor,
                          Feature::kSphere}) {
    const Calibration c = measure(room(f), settings);
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
