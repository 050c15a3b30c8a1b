#include "bake/radiosity/certificate.h"

#include <algorithm>

#include "bake/jobs/units.h"
#include "bake/radiosity/texels/texel_paths.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr std::uint32_t kPaths = 64;      // a texel
constexpr std::uint64_t kShare = 20;      // one ray in so many of the bake's
constexpr std::uint64_t kRaysAPath = 10;  // about
constexpr std::size_t kLeastTexels = 64, kMostTexels = 4096;

struct Sampled {
  std::size_t page, index;
  DVec3 baked{0}, path{0}, variance{0};
  bool compared = false;  // false: nearly all of its points are buried
};

std::vector<Sampled> choose(std::span<const TexelMapPage> map, const Radiosity& radiosity, std::size_t count,
                            std::uint64_t seed) {
  std::vector<std::size_t> first{0};
  for (const TexelMapPage& page : map) first.push_back(first.back() + page.texel.size());
  std::vector<Sampled> chosen;
  for (std::uint64_t k = 0; chosen.size() < count && k < 4 * count && first.back() > 0; ++k) {
    const std::size_t at = mix64(seed ^ mix64(k)) % first.back();
    const std::size_t page =
        static_cast<std::size_t>(std::upper_bound(first.begin(), first.end(), at) - first.begin()) - 1;
    const std::size_t index = at - first[page];
    const std::uint32_t texel = map[page].texel[index];
    if (radiosity.pages[page].state[texel] != TexelState::kValid) continue;
    chosen.push_back({page, index, DVec3(radiosity.pages[page].irradiance[texel])});
  }
  return chosen;
}

// The ratio Σ (baked - path) / Σ path in luminance, and 1.96 standard errors of it.
void state_bias(const std::vector<Sampled>& samples, Certificate& c) {
  double difference = 0, path = 0, squares = 0;
  for (const Sampled& s : samples) difference += luminance(Vec3(s.baked - s.path)), path += luminance(Vec3(s.path));
  if (!(path > 0)) return;
  c.bias = difference / path;
  for (const Sampled& s : samples) {
    const double residual = luminance(Vec3(s.baked - s.path)) - c.bias * luminance(Vec3(s.path));
    squares += residual * residual;
  }
  c.bias_interval = 1.96 * std::sqrt(squares) / path;
}

// Root mean square of the relative difference, without what the paths' own noise adds to it.
void state_error(const std::vector<Sampled>& samples, const DVec3& mean, Certificate& c) {
  double squares = 0, noise = 0;
  for (const Sampled& s : samples)
    for (int k = 0; k < 3; ++k) {
      const double denominator = s.baked[k] * s.baked[k] + 1e-4 * mean[k] * mean[k];
      if (!(denominator > 0)) continue;
      squares += (s.baked[k] - s.path[k]) * (s.baked[k] - s.path[k]) / denominator;
      noise += s.variance[k] / denominator;
    }
  c.relative_error = std::sqrt(std::max(0.0, squares - noise) / (3.0 * static_cast<double>(samples.size())));
}

}  // namespace

Result<Certificate> certify(const Transport& transport, const Atlas& atlas, std::span<const TexelMapPage> texel_map,
                            const Radiosity& radiosity, std::uint64_t rays_of_bake, Context& context) {
  const std::size_t wanted =
      std::clamp<std::size_t>(rays_of_bake / (kShare * kRaysAPath * kPaths), kLeastTexels, kMostTexels);
  std::vector<Sampled> samples = choose(texel_map, radiosity, wanted, context.seed);
  Certificate c;
  c.texels = samples.size();
  c.paths = kPaths;
  if (samples.empty()) return c;
  Context own;  // other random numbers, the same threads
  own.seed = mix64(context.seed + 0xce27);
  const TexelPaths paths(transport, atlas, false, own);
  std::atomic<std::uint64_t> rays{0};
  UnitLoop loop{.stage = "certificate", .count = samples.size(), .rays = double{kPaths * kRaysAPath}};
  loop.inputs = [&](std::size_t k, Archive& key) { key(samples[k].page, samples[k].index); };
  loop.compute = [&](std::size_t k) {
    Sampled& s = samples[k];
    TexelSums sums;
    std::uint64_t traced = 0;
    paths.add(texel_map[s.page], s.page, s.index, 0, kPaths, sums, traced);
    s.path = sums.irradiance();
    s.variance = sums.variance();
    s.compared = sums.count >= kPaths / 4;
    return traced;
  };
  loop.results = [&](std::size_t k, Archive& archive) {
    archive(samples[k].path, samples[k].variance, samples[k].compared);
  };
  ORIEL_TRY_VOID(parallel_units(context, loop, &rays));
  c.rays = rays;
  std::erase_if(samples, [](const Sampled& s) { return !s.compared; });
  c.texels = samples.size();
  if (samples.empty()) return c;
  state_bias(samples, c);
  state_error(samples, DVec3(radiosity.report.mean), c);
  return c;
}

}  // namespace oriel
