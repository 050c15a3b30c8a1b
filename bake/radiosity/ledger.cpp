#include "bake/radiosity/ledger.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "bake/jobs/parallel.h"
#include "bake/radiosity/particle.h"
#include "bake/radiosity/texels/texels.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr std::uint64_t kRaysAParticle = 6, kLeastParticles = 4096,
                        kMostParticles = 65536;  // about; particles of each kind of source
constexpr std::size_t kItemsATask = 64;          // particles or texels a task
constexpr double kCertain = 3;                   // standard errors

// A sum with its standard error, from independent samples.
class Sum {
 public:
  void add(double x) { sum_ += x, squares_ += x * x, ++count_; }
  // Adds the mean of the samples, each of which estimates the whole.
  void into(Lumens& lumens) const {
    const double n = std::max(1.0, count_), mean = sum_ / n;
    const double variance = std::max(0.0, squares_ / n - mean * mean) / std::max(1.0, n - 1);
    lumens.value += mean;
    lumens.error = std::sqrt(lumens.error * lumens.error + variance);
  }

 private:
  double sum_ = 0, squares_ = 0, count_ = 0;
};

void add_kind(SourceKind kind, std::span<const Fate> fates, double lamps_lm, Ledger& ledger) {
  Sum afar, absorbed, escaped, behind, guard, missing, texels;
  for (const Fate& f : fates) {
    // Emission of lamps is known exactly: samples have noise by their points.
    const double emitted = kind == SourceKind::kNear ? lamps_lm : f.emitted;
    if (kind != SourceKind::kNear) afar.add(f.emitted);
    absorbed.add(f.absorbed);
    escaped.add(f.escaped);
    behind.add(f.lost_behind);
    guard.add(f.lost_guard);
    missing.add(emitted - f.absorbed - f.escaped - f.lost_behind - f.lost_guard);
    texels.add(f.on_texels);
  }
  afar.into(ledger.from_afar);
  absorbed.into(ledger.absorbed);
  escaped.into(ledger.escaped);
  behind.into(ledger.lost_behind);
  guard.into(ledger.lost_guard);
  missing.into(ledger.missing);
  texels.into(ledger.on_texels);
}

EvaluatedTexels evaluated_texels(const Atlas& atlas, std::span<const TexelMapPage> texel_map,
                                 const Radiosity& radiosity) {
  EvaluatedTexels out{atlas, texel_map, {}};
  for (std::size_t p = 0; p < texel_map.size(); ++p) {
    const TexelMapPage& map = texel_map[p];
    std::vector<bool>& evaluated = out.evaluated.emplace_back(std::size_t{map.width} * map.height);
    for (std::size_t i = 0; i < map.texel.size(); ++i)
      evaluated[map.texel[i]] =
          radiosity.pages[p].state[map.texel[i]] == TexelState::kValid && radiosity.visible[p][i] >= 1;
  }
  return out;
}

// Flux absorbed at evaluated texels by the lightmap, with absorptance() at a point of each, lm.
Result<double> absorbed_by_lightmap(const Scene& scene, const EvaluatedTexels& texels, const Radiosity& radiosity,
                                    Context& context) {
  double sum = 0;
  for (std::size_t p = 0; p < texels.map.size(); ++p) {
    const TexelMapPage& map = texels.map[p];
    const LightmapPage& page = radiosity.pages[p];
    std::vector<double> absorbed_by_run((map.texel.size() + kItemsATask - 1) / kItemsATask);
    ORIEL_TRY_VOID(parallel_for(context, "", absorbed_by_run.size(), [&](std::size_t run) {
      for (std::size_t i = run * kItemsATask; i < std::min(map.texel.size(), (run + 1) * kItemsATask); ++i) {
        if (!texels.evaluated[p][map.texel[i]]) continue;
        Sampler sampler(context.seed, p << 32u | i, 0);
        const Vec2 u = sampler.next2();
        const TexelPoint at = sample_texel(texels.atlas, map, i, Vec3(u, sampler.next1()));
        const Vec3 light = page.irradiance[map.texel[i]] * absorptance(shade_point(scene, at.triangle, at.barycentric));
        absorbed_by_run[run] += luminance(DVec3(light)) * texel_area_m2(scene, texels.atlas, map, i);
      }
    }));
    for (const double part : absorbed_by_run) sum += part;
  }
  return sum;
}

std::string percent(double value, double error) {
  return fmt::format("{:.3g} % ± {:.2g} %", 100 * value, 100 * error);
}

}  // namespace

double Ledger::disagreement() const {
  const double larger = std::max(std::abs(on_texels.value), lightmap_lm);
  return larger > 0 ? std::abs(on_texels.value - lightmap_lm) / larger : 0;
}

double Ledger::disagreement_error() const {
  const double larger = std::max(std::abs(on_texels.value), lightmap_lm);
  return larger > 0 ? on_texels.error / larger : 0;
}

Result<Ledger> keep_ledger(const LightmapScene& scene, const Radiosity& radiosity, std::uint64_t rays_at_most,
                           Context& context) {
  const auto& [transport, atlas, texel_map] = scene;
  Ledger ledger;
  const EvaluatedTexels texels = evaluated_texels(atlas, texel_map, radiosity);
  const Sources sources(transport.accel.scene(), transport.lights);
  if (sources.kinds().empty()) return ledger;
  ledger.lamps_lm = luminance(transport.lights.power());
  const std::uint64_t wanted = rays_at_most / (kRaysAParticle * sources.kinds().size());
  std::vector<Fate> fates(std::bit_floor(std::clamp(wanted, kLeastParticles, kMostParticles)));
  std::atomic<std::uint64_t> rays{0};
  for (const SourceKind kind : sources.kinds()) {
    const std::uint64_t stream = mix64(0x1ed6e4 + static_cast<std::uint64_t>(kind));
    ORIEL_TRY_VOID(parallel_for({context, &rays}, "ledger", fates.size() / kItemsATask, [&](std::size_t run) {
      std::uint64_t traced = 0;
      for (std::size_t i = run * kItemsATask; i < (run + 1) * kItemsATask; ++i) {
        Sampler sampler(context.seed, stream, static_cast<std::uint32_t>(i));
        const Particle particle = sources.emit(kind, sampler);
        fates[i] = follow(transport, texels, particle, sampler, traced);
      }
      rays += traced;
    }));
    add_kind(kind, fates, ledger.lamps_lm, ledger);
    ledger.particles += fates.size();
  }
  ledger.rays = rays;
  ORIEL_TRY(ledger.lightmap_lm, absorbed_by_lightmap(transport.accel.scene(), texels, radiosity, context));
  return ledger;
}

std::vector<std::string> ledger_findings(const Ledger& ledger) {
  std::vector<std::string> findings;
  if (ledger.closure() > kLedgerTolerance + kCertain * ledger.closure_error())
    findings.push_back(fmt::format(
        "the energy ledger is open: {} of {:.4g} lm are neither absorbed nor escaped nor lost, expected at most {} %: "
        "the light of some surface is not computed right",
        percent(ledger.closure(), ledger.closure_error()), ledger.emitted_lm(), 100 * kLedgerTolerance));
  if (ledger.disagreement() > kLedgerTolerance + kCertain * ledger.disagreement_error())
    findings.push_back(fmt::format(
        "the lightmap has {:.4g} lm on its surfaces, light followed from its sources brings {:.4g} lm: {} apart, "
        "expected at most {} %: it is too {} somewhere, mostly where light changes within texels; a finer --texel "
        "mends "
        "that, --verify names the worst places",
        ledger.lightmap_lm, ledger.on_texels.value, percent(ledger.disagreement(), ledger.disagreement_error()),
        100 * kLedgerTolerance, ledger.lightmap_lm > ledger.on_texels.value ? "bright" : "dark"));
  return findings;
}

}  // namespace oriel
