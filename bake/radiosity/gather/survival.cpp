#include "bake/radiosity/gather/survival.h"

#include "bake/jobs/parallel.h"
#include "bake/radiosity/gather/gather_point.h"
#include "bake/radiosity/texels/seeds.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr std::size_t kTexels = 1024;
constexpr std::uint32_t kRays = 32;             // a texel
constexpr float kPathCost = 4;                  // cost of a path through layers, in rays
constexpr double kFloor = 0.5;                  // of the mean light: the least light of a texel
constexpr float kLeast = 0.5f, kMost = 64;      // times the reflectance
constexpr std::uint64_t kStreams = 1ull << 40;  // no gather ray has these

// Sums over rays from some texels, in units of the texels' own light.
struct Noise {
  double variance = 0;         // of all light but that reflected by layers
  std::vector<double> layers;  // by material: mean square of their light, survival 1
  std::vector<double> paths;   // by material: sum of reflectance
  double rays = 0;

  explicit Noise(std::size_t materials) : layers(materials), paths(materials) {}
  void add(const Noise& other) {
    variance += other.variance, rays += other.rays;
    for (std::size_t m = 0; m < layers.size(); ++m) layers[m] += other.layers[m], paths[m] += other.paths[m];
  }
};

class SurvivalCalibration {
 public:
  SurvivalCalibration(const Texels& texels, const CacheQuery& query, const CachedLight& cached)
      : texels_(texels), query_(query), cached_(cached), scene_(query.transport().accel.scene()) {
    double sum = 0;
    for (const Vec3& e : cached.irradiance) sum += luminance(e);
    floor_ = kFloor * sum / static_cast<double>(std::max<std::size_t>(1, cached.irradiance.size()));
  }

  // `seed`: of directions.
  Noise measure(std::uint32_t texel, std::uint64_t seed, std::uint64_t& traced) const {
    Noise noise(scene_.materials.size());
    const double own = std::max<double>(luminance(cached_.irradiance[texel]), floor_);
    if (texels_.visible[texel] == 0 || !(own > 0)) return noise;
    const QueryResults results = trace(texel, seed, traced);
    std::vector<Vec3> through(kRays, Vec3(0));
    for (const Link& link : results.links) through[link.ray] += link.weight * cached_.irradiance[link.texel] / kPi;
    double sum = 0, squares = 0;
    for (std::uint32_t i = 0; i < kRays; ++i) {
      const std::uint32_t met = results.texel[i];
      const Vec3 specular = results.light[i] + through[i];
      const bool layered = met != kNoTexel && results.share[i] < 1;
      double rest = luminance(layered ? Vec3(0) : specular);
      if (met != kNoTexel) rest += results.share[i] * luminance(cached_.texels[met].radiance);
      rest *= kPi / own;
      sum += rest, squares += rest * rest;
      if (!layered) continue;
      const double reflected = luminance(specular) * kPi / own;
      const std::uint32_t material = scene_.surfaces[scene_.triangle_surface[results.hits[i].triangle]].material;
      if (std::isfinite(reflected)) noise.layers[material] += reflected * reflected;
      noise.paths[material] += 1 - results.share[i];
    }
    if (std::isfinite(squares)) noise.variance = std::max(0.0, squares - sum * sum / kRays);
    noise.rays = kRays;
    return noise;
  }

 private:
  QueryResults trace(std::uint32_t texel, std::uint64_t seed, std::uint64_t& traced) const {
    std::vector<Ray> batch;
    std::vector<GatherRay> info;
    for (std::uint32_t k = 0; k < kRays; ++k) {
      const GatherPoint point(texels_.sample_point(texel, static_cast<int>(k % kHalves), k / kHalves));
      batch.push_back(point.ray(Sampler(seed, texel, k).next2()));
      info.push_back({query_.weighs() ? point.incidence(batch.back().direction) : 0, kStreams + texel, k, true});
    }
    QueryResults results;
    query_.evaluate(batch, info, results);
    traced += batch.size() + results.rays;
    return results;
  }

  const Texels& texels_;
  const CacheQuery& query_;
  const CachedLight& cached_;
  const Scene& scene_;
  double floor_ = 0;
};

}  // namespace

Status learn_survival(const Texels& texels, CacheQuery& query, std::span<const std::uint32_t> order,
                      const CachedLight& cached, const Stage& stage) {
  const std::size_t materials = query.transport().accel.scene().materials.size();
  const std::size_t count = std::min(kTexels, order.size());
  std::vector<Noise> by_texel(count, Noise(0));
  const SurvivalCalibration calibration(texels, query, cached);
  ORIEL_TRY_VOID(parallel_for(stage, "", count, [&](std::size_t i) {
    std::uint64_t traced = 0;
    by_texel[i] = calibration.measure(order[i * order.size() / count], stage.context.seed + seeds::kSurvival, traced);
    stage.count(traced);
  }));
  Noise all(materials);
  for (const Noise& noise : by_texel) all.add(noise);
  // The minimum of (variance + Σ layers / b) (rays + cost Σ paths b).
  std::vector<float> survival(materials, 1.0f);
  for (std::size_t m = 0; m < materials; ++m) {
    if (!(all.layers[m] > 0) || !(all.variance > 0)) continue;
    const double best = std::sqrt(all.layers[m] / (kPathCost * all.paths[m]) * all.rays / all.variance);
    survival[m] = std::clamp(static_cast<float>(std::exp2(std::round(std::log2(best)))), kLeast, kMost);
  }
  query.set_survival(std::move(survival));
  return {};
}

}  // namespace oriel
