// Error against time of both estimators on one scene, against a converged reference of our own.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "bake/import/import.h"
#include "bake/radiosity/radiosity.h"

namespace oriel {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Where the time went: seconds by progress stage, in order of appearance.
class Phases {
 public:
  void operator()(const Progress& progress) {
    const auto now = std::chrono::steady_clock::now();
    if (seconds_.empty() || seconds_.back().first != progress.stage) seconds_.emplace_back(progress.stage, 0.0);
    seconds_.back().second += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }
  void start() {
    seconds_.clear();
    last_ = std::chrono::steady_clock::now();
  }
  void print() const {
    for (const auto& [stage, seconds] : seconds_) std::printf("    %-14s %.3f s\n", stage.c_str(), seconds);
  }

 private:
  std::vector<std::pair<std::string, double>> seconds_;
  std::chrono::steady_clock::time_point last_;
};

struct Errors {
  double rel = 0, net = 0, n = 0, bias = 0, covered = 0;
};

// relRMSE, nRMSE, bias of the means, and the share of texels within 1.96 standard errors of both.
Errors compare(const Radiosity& x, const Radiosity& r, std::span<const TexelMapPage> map) {
  DVec3 mean(0), difference(0);
  std::size_t count = 0;
  const auto each = [&](const auto& visit) {
    for (std::size_t p = 0; p < map.size(); ++p)
      for (const std::uint32_t t : map[p].texel)
        if (x.pages[p].state[t] == TexelState::kValid && r.pages[p].state[t] == TexelState::kValid)
          visit(x.pages[p], r.pages[p], t);
  };
  each([&](const LightmapPage& a, const LightmapPage& b, std::uint32_t t) {
    mean += DVec3(b.irradiance[t]);
    difference += DVec3(a.irradiance[t]) - DVec3(b.irradiance[t]);
    ++count;
  });
  mean /= static_cast<double>(count);
  Errors e;
  double noise = 0;
  each([&](const LightmapPage& a, const LightmapPage& b, std::uint32_t t) {
    for (int c = 0; c < 3; ++c) {
      const double v = b.irradiance[t][c], d = a.irradiance[t][c] - v, floor = 0.01 * mean[c];
      const double se2 = double{b.standard_error[t][c]} * b.standard_error[t][c];
      e.rel += d * d / (v * v + floor * floor);
      noise += se2 / (v * v + floor * floor);
      e.n += d * d / (mean[c] * mean[c]);
      e.covered += d * d <= 1.96 * 1.96 * (se2 + double{a.standard_error[t][c]} * a.standard_error[t][c]);
    }
  });
  const double n = 3.0 * static_cast<double>(count);
  e.net = std::sqrt(std::max(0.0, (e.rel - noise) / n));
  e.rel = std::sqrt(e.rel / n), e.n = std::sqrt(e.n / n), e.covered /= n;
  e.bias = (difference.r + difference.g + difference.b) / ((mean.r + mean.g + mean.b) * static_cast<double>(count));
  return e;
}

// Where the means differ most: by surface, in the scene's light.
void print_biases(const Scene& scene, const Radiosity& x, const Radiosity& r, std::span<const TexelMapPage> map) {
  struct Sum {
    double difference = 0, reference = 0, noise = 0;
  };
  std::vector<Sum> sums(scene.surfaces.size());
  for (std::size_t p = 0; p < map.size(); ++p)
    for (std::size_t i = 0; i < map[p].texel.size(); ++i) {
      const std::uint32_t t = map[p].texel[i];
      if (r.pages[p].state[t] != TexelState::kValid) continue;
      Sum& sum = sums[scene.triangle_surface[map[p].fragments[map[p].first[i]].triangle]];
      sum.difference += x.pages[p].irradiance[t].g - r.pages[p].irradiance[t].g;
      sum.reference += r.pages[p].irradiance[t].g;
      sum.noise += std::pow(r.pages[p].standard_error[t].g, 2);
    }
  std::vector<std::size_t> order(sums.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return std::abs(sums[a].difference) > std::abs(sums[b].difference); });
  for (std::size_t k = 0; k < std::min<std::size_t>(16, order.size()); ++k) {
    const Sum& sum = sums[order[k]];
    std::printf("    %-24s bias %+.2f %% ± %.2f\n", scene.surfaces[order[k]].name.c_str(),
                100 * sum.difference / sum.reference, 196 * std::sqrt(sum.noise) / sum.reference);
  }
}

int bench(int argc, char** argv) {
  const char* file = argv[1];
  const int reference = argc > 2 ? std::atoi(argv[2]) : 1024;
  const bool uv1 = argc > 3 && std::strcmp(argv[3], "uv1") == 0;
  Context context;
  const auto imported = import_gltf(file, {}, context);
  if (!imported) {
    std::fprintf(stderr, "%s\n", imported.error().text().c_str());
    return static_cast<int>(imported.error().code);
  }
  const Scene& scene = imported->scene;
  AtlasOptions atlas_options;
  if (uv1) atlas_options.source = AtlasOptions::Source::kUv1, atlas_options.resolution = 256;
  const auto atlas = build_atlas(scene, atlas_options, context);
  const auto map = build_texel_map(*atlas, context);
  const auto accel = Accel::build(scene);
  const LightSet lights(scene);
  const Transport transport{*accel, lights, {}};
  context.seed = 99;
  auto start = std::chrono::steady_clock::now();
  RadiosityOptions options;
  options.samples = static_cast<std::uint32_t>(reference);
  options.dilation = 0;
  const auto truth = bake_radiosity({transport, *atlas, *map}, options, context);
  std::printf("reference %d paths: %.2f s, stated error %.2f %%, %zu texels\n", reference, seconds_since(start),
              100 * truth->report.relative_error, truth->report.texels);
  context.seed = 1;
  Phases phases;
  context.progress = [&](const Progress& progress) { phases(progress); };
  const auto run = [&](const char* name, const RadiosityOptions& o) {
    phases.start();
    start = std::chrono::steady_clock::now();
    const auto baked = bake_radiosity({transport, *atlas, *map}, o, context);
    const double seconds = seconds_since(start);
    if (!baked) {
      std::printf("%s: %s\n", name, baked.error().text().c_str());
      return;
    }
    const Errors e = compare(*baked, *truth, *map);
    std::printf(
        "%-22s %6.2f s %6.1f Mray %5.1f Mray/s  stated %6.2f %%  net %6.2f %%  nRMSE %6.2f %%  bias %+.2f %%  in 95 "
        "%%: "
        "%.1f %%  sweeps %d drift %+.3f %%\n",
        name, seconds, baked->report.rays * 1e-6, baked->report.rays * 1e-6 / seconds,
        100 * baked->report.relative_error, 100 * e.net, 100 * e.n, 100 * e.bias, 100 * e.covered, baked->report.sweeps,
        100 * baked->report.filter_drift);
    phases.print();
    print_biases(scene, *baked, *truth, *map);
  };
  for (const std::uint32_t samples : {16u, 256u}) {
    RadiosityOptions o = options;
    o.estimator = Estimator::kCached;
    o.samples = samples;
    run(("cached " + std::to_string(samples)).c_str(), o);
    o.filter.strength = 0;
    run(("cached raw " + std::to_string(samples)).c_str(), o);
  }
  for (const double error : {0.05}) {
    RadiosityOptions o = options;
    o.estimator = Estimator::kCached;
    o.samples = 4096;
    o.error = error;
    run(("cached error " + std::to_string(error)).c_str(), o);
  }
  for (const std::uint32_t samples : {16u}) {
    RadiosityOptions o = options;
    o.samples = samples;
    run(("reference " + std::to_string(samples)).c_str(), o);
  }
  return 0;
}

}  // namespace
}  // namespace oriel

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: lightmap_bench SCENE.glb [REFERENCE_PATHS] [uv1]\n");
    return 1;
  }
  return oriel::bench(argc, argv);
}
