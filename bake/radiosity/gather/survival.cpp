#include "bake/radiosity/gather/survival.h"

#include "bake/jobs/parallel.h"
#include "bake/radiosity/gather/gather_site.h"
#include "bake/radiosity/texels/seeds.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr std::size_t kTexels = 4096;
constexpr std::uint32_t kRays = 32;             // a texel
constexpr float kPathCost = 4;                  // rays that a path through layers is worth: shading, light, rays
constexpr double kFloor = 0.5;                  // of the mean light: darker is as if it were that
constexpr float kLeast = 0.5f, kMost = 64;      // times the reflectance
constexpr std::uint64_t kStreams = 1ull << 40;  // no gather ray has these

// Sums over rays from some texels, in units of the texels' own light.
struct Noise {
  double variance = 0;         // of all light but what layers reflect
  std::vector<double> layers;  // by material: mean square of what they reflect, survival being 1
  std::vector<double> paths;   // by material: reflectance met
  double rays = 0;

  explicit Noise(std::size_t materials) : layers(materials), paths(materials) {}
  void add(const Noise& other) {
    variance += other.variance, rays += other.rays;
    for (std::size_t m = 0; m < layers.size(); ++m) layers[m] += other.layers[m], paths[m] += other.paths[m];
  }
};

class Pilot {
 public:
  Pilot(const Texels& texels, const Surroundings& around, const CachedLight& cached)
      : texels_(texels), around_(around), cached_(cached), scene_(around.transport().accel.scene()) {
    double sum = 0;
    for (const Vec3& e : cached.irradiance) sum += luminance(e);
    floor_ = kFloor * sum / static_cast<double>(std::max<std::size_t>(1, cached.irradiance.size()));
  }

  // `seed`: of directions.
  Noise measure(std::uint32_t texel, std::uint64_t seed, std::uint64_t& traced) const {
    Noise noise(scene_.materials.size());
    const double own = std::max<double>(luminance(cached_.irradiance[texel]), floor_);
    if (texels_.visible[texel] == 0 || !(own > 0)) return noise;
    const Answers answers = look(texel, seed, traced);
    std::vector<Vec3> through(kRays, Vec3(0));
    for (const Link& link : answers.links) through[link.ray] += link.weight * cached_.irradiance[link.texel] / kPi;
    double sum = 0, squares = 0;
    for (std::uint32_t i = 0; i < kRays; ++i) {
      const std::uint32_t met = answers.texel[i];
      const Vec3 specular = answers.light[i] + through[i];
      const bool layered = met != kNoTexel && answers.share[i] < 1;
      double rest = luminance(layered ? Vec3(0) : specular);
      if (met != kNoTexel) rest += answers.share[i] * luminance(cached_.texels[met].radiance);
      rest *= kPi / own;
      sum += rest, squares += rest * rest;
      if (!layered) continue;
      const double reflected = luminance(specular) * kPi / own;
      const std::uint32_t material = scene_.surfaces[scene_.triangle_surface[answers.hits[i].triangle]].material;
      if (std::isfinite(reflected)) noise.layers[material] += reflected * reflected;
      noise.paths[material] += 1 - answers.share[i];
    }
    if (std::isfinite(squares)) noise.variance = std::max(0.0, squares - sum * sum / kRays);
    noise.rays = kRays;
    return noise;
  }

 private:
  Answers look(std::uint32_t texel, std::uint64_t seed, std::uint64_t& traced) const {
    std::vector<Ray> batch;
    std::vector<GatherRay> about;
    for (std::uint32_t k = 0; k < kRays; ++k) {
      const GatherSite site(texels_.sample_point(texel, static_cast<int>(k % kHalves), k / kHalves));
      batch.push_back(site.ray(Sampler(seed, texel, k).next2()));
      about.push_back({around_.weighs() ? site.incidence(batch.back().direction) : 0, kStreams + texel, k, true});
    }
    Answers answers;
    around_.answer(batch, about, answers);
    traced += batch.size() + answers.rays;
    return answers;
  }

  const Texels& texels_;
  const Surroundings& around_;
  const CachedLight& cached_;
  const Scene& scene_;
  double floor_ = 0;
};

}  // namespace

Status learn_survival(const Texels& texels, Surroundings& around, std::span<const std::uint32_t> order,
                      const CachedLight& cached, const Stage& stage) {
  const std::size_t materials = around.transport().accel.scene().materials.size();
  const std::size_t count = std::min(kTexels, order.size());
  std::vector<Noise> by_texel(count, Noise(0));
  const Pilot pilot(texels, around, cached);
  ORIEL_TRY_VOID(parallel_for(stage, "", count, [&](std::size_t i) {
    std::uint64_t traced = 0;
    by_texel[i] = pilot.measure(order[i * order.size() / count], stage.context.seed + seeds::kSurvival, traced);
    stage.count(traced);
  }));
  Noise all(materials);
  for (const Noise& noise : by_texel) all.add(noise);
  // The least of (variance + Σ layers / b) (rays + cost Σ paths b), where the two factors have even shares.
  std::vector<float> survival(materials, 1.0f);
  for (std::size_t m = 0; m < materials; ++m) {
    if (!(all.layers[m] > 0) || !(all.variance > 0)) continue;
    const double best = std::sqrt(all.layers[m] / (kPathCost * all.paths[m]) * all.rays / all.variance);
    survival[m] = std::clamp(static_cast<float>(std::exp2(std::round(std::log2(best)))), kLeast, kMost);
  }
  around.set_survival(std::move(survival));
  return {};
}

}  // namespace oriel
