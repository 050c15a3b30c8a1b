#include "bake/plan/predict.h"

#include <algorithm>
#include <cmath>

#include "bake/run/assemble.h"
#include "bake/run/fit_maps.h"
#include "bake/run/inputs.h"
#include "bake/run/shortfalls.h"
#include "formats/pack/writer.h"

namespace oriel {
namespace {

constexpr double kCoarser = 4;              // texels of the finer pilot: 1/16 as many, of the coarser one 1/64
constexpr double kLeastPilotTexels = 2000;  // of the finer one, where the scene has as many
constexpr double kMissed = 1.5;             // the error asked for by so much: rays a texel are limited
constexpr double kNominalError = 0.02;      // of pilots where time alone limits the work
constexpr double kLeastAskedError = 1e-3;   // what a bake limited by time alone asks for

constexpr double kMostPlan_s = 25;          // that a plan takes, but for what ends late: it is read before a bake
constexpr double kMostOfTime = 0.25;        // of --time likewise
constexpr double kLeastPilot = 0.4;         // of these, where preparation took more than the rest
constexpr double kUntil[2] = {0.25, 0.75};  // of the pilot's time: a coarser bake has a quarter of the texels

// Of a map's bytes, what a pack stores: 0.27 of the gallery's radiance maps, 0.46 of the studio's surround maps.
constexpr double kStoredShare = 0.35;

// Mesh, materials and textures alone: whole with lightmaps for the atlas's pages.
Pack pack_of_scene(const Scene& scene, const Atlas& atlas) {
  Pack pack;
  pack.mesh = assemble_mesh(scene, atlas).mesh;
  MaterialMaps none;
  none.summaries.resize(scene.materials.size());
  none.kernel.assign(scene.materials.size(), -1);
  none.fresnel_map.assign(scene.materials.size(), -1);
  assemble_materials(scene, none, pack);
  return pack;
}

// A small bake of the lightmap.
struct LightmapPilot {
  Atlas atlas;
  Radiosity radiosity;
  double texels = 0, seconds = 0;
  bool ended = false;             // by its time
  double bytes = 0;               // of the lightmap in a pack
  std::uint64_t scene_bytes = 0;  // of a pack whose lightmap is black
};

// What the scene itself takes in a pack, and what its lightmap adds to that.
Status weigh(const Scene& scene, LightmapPilot& pilot) {
  Pack pack = pack_of_scene(scene, pilot.atlas);
  pack.lightmaps = pilot.radiosity.pages;
  for (LightmapPage& page : pack.lightmaps) {
    std::fill(page.irradiance.begin(), page.irradiance.end(), Vec3(0));
    std::fill(page.standard_error.begin(), page.standard_error.end(), Vec3(0));
    std::fill(page.direction.begin(), page.direction.end(), Vec3(0));
    page.cell.clear(), page.detail.clear(), page.detail_width = page.detail_height = 0;
  }
  ORIEL_TRY(const Bytes without, encode_pack(pack));
  pack.lightmaps = pilot.radiosity.pages;
  ORIEL_TRY(const Bytes with, encode_pack(pack));
  pilot.scene_bytes = without.size();
  pilot.bytes = static_cast<double>(with.size()) - static_cast<double>(without.size());
  return {};
}

RadiosityOptions pilot_options(const CensusInput& in) {
  RadiosityOptions options = in.options.radiosity;
  std::vector<Warning> ignored;
  options.directional = choose_directional(in.prepared.scene(), in.options.directional, ignored);
  if (in.options.time_s > 0 && options.error <= kLeastAskedError) options.error = kNominalError;
  options.verify = 0;
  return options;
}

double texels_of(std::span<const TexelMapPage> pages) {
  double texels = 0;
  for (const TexelMapPage& page : pages) texels += static_cast<double>(page.texel.size());
  return texels;
}

// left: seconds until it ends.
Result<LightmapPilot> bake_coarse(const CensusInput& in, double coarser, const std::function<double()>& left,
                                  Context& context) {
  LightmapPilot pilot;
  AtlasOptions coarse = in.options.atlas;
  coarse.source = AtlasOptions::Source::kAuto;
  coarse.resolution = 0;
  coarse.texel_m = static_cast<float>(coarser) * in.prepared.atlas.texel_m;
  ORIEL_TRY(pilot.atlas, build_atlas(in.prepared.scene(), coarse, context, in.prepared.demand));
  ORIEL_TRY(const auto texel_map, build_texel_map(pilot.atlas, context));
  const ElapsedTime clock;
  RadiosityOptions options = pilot_options(in);
  options.left = options.left_of_all = left;
  options.enough = [&options] { return options.late(); };
  const Transport transport{*in.prepared.accel, in.lights, path_options(in.options)};
  const StageInputs inputs(context, SurfacesOf{in.prepared.scene()}, LightsOf{in.prepared.scene()},
                           LayoutOf{pilot.atlas}, transport.options.max_bounces);
  ORIEL_TRY(pilot.radiosity, bake_radiosity({transport, pilot.atlas, texel_map}, options, context));
  pilot.ended = pilot.radiosity.report.ended_early;
  pilot.seconds = clock.spent();
  pilot.texels = texels_of(texel_map);
  ORIEL_TRY_VOID(weigh(in.prepared.scene(), pilot));
  return pilot;
}

double most_refining_rays(const RadiosityOptions& options, double texels) {
  if (options.most_rays == 0 || options.estimator != Estimator::kCached) return HUGE_VAL;
  return std::max(static_cast<double>(options.most_rays), static_cast<double>(kMostTexelMean) * texels);
}

Component extrapolate(const CensusInput& in, const LightmapPilot (&pilots)[2]) {
  const double texels = texels_of(in.prepared.texel_map);
  const double n[2] = {pilots[0].texels, pilots[1].texels};
  const auto at_all = [&](const auto& work) {
    const double w[2] = {work(pilots[0]), work(pilots[1])};
    return fit_work(n, w).at(texels);
  };
  Component c{.name = "radiosity"};
  const LightmapPilot& fine = pilots[1];
  const RadiosityReport& report = fine.radiosity.report;
  // Where the limit of rays a texel ends the work, texels all cost about that.
  const bool limited = report.relative_error > kMissed * pilot_options(in).error && pilot_options(in).error > 0;
  double rays = limited ? static_cast<double>(report.rays) * texels / n[1]
                        : at_all([](const LightmapPilot& p) { return static_cast<double>(p.radiosity.report.rays); });
  // Noise of a pilot that its time ended falls with rays.
  if (limited && fine.ended) rays *= std::pow(report.relative_error / pilot_options(in).error, 2);
  // Where refinement ends for its rays, squared errors stay larger by what was cut.
  const double first = static_cast<double>(report.first_rays) * texels / n[1];
  const double cut = std::max(1.0, (rays - first) / most_refining_rays(in.options.radiosity, texels));
  rays = std::min(rays, first + (rays - first) / cut);
  const double verify = in.options.radiosity.verify;
  c.rays = static_cast<std::uint64_t>(rays * (1 + verify));
  c.seconds = fine.seconds * rays * (1 + kSlowPaths * verify) / std::max(1.0, static_cast<double>(report.rays));
  c.bytes = static_cast<std::uint64_t>(std::max(0.0, at_all([](const LightmapPilot& p) { return p.bytes; })));
  // Squared errors add over texels; those that miss what was asked lie on edges.
  const double squares = at_all([](const LightmapPilot& p) {
    return p.texels * p.radiosity.report.relative_error * p.radiosity.report.relative_error;
  });
  const double reached = fine.ended ? 0 : std::sqrt(squares / std::max(1.0, texels));
  c.error = std::max(reached, pilot_options(in).error) * std::sqrt(cut);
  return c;
}

// Radiance and surround maps: planned as the bake plans them, with fewer samples where all take longer than `seconds`;
// a few of their pixels captured as the bake does to tell its own time.
Result<Component> predict_reflections(const CensusInput& in, double seconds, Context& context) {
  BakeOptions options = in.options;
  options.planned.memory_bytes = ~std::uint64_t{0};  // how much all would take is asked
  Pack dark;
  const BakeTask task{options, in.prepared, in.lights, context, {}};
  ORIEL_TRY(PlannedReflections planned, plan_reflections(task, in.reflections, 0.5 * seconds));
  planned.seconds *= planned.divisor;
  if (planned.has_images()) ORIEL_TRY_VOID(time_reflections(task, dark, planned));
  Component c{.name = "radiance", .seconds = planned.seconds + planned.capture_s};
  c.raw_bytes = static_cast<std::uint64_t>(kMapBytesPerPixel * (planned.planar_pixels() + planned.surround_pixels()));
  c.bytes = static_cast<std::uint64_t>(kStoredShare * static_cast<double>(c.raw_bytes));
  return c;
}

void add_limits(const CensusInput& in, Prediction& p) {
  const Component* light = nullptr;
  for (const Component& c : p.components)
    if (c.name == "radiosity") light = &c;
  if (!light) return;
  const double error = in.options.radiosity.error, time = in.options.time_s;
  if (error > kLeastAskedError || time <= 0) {
    const bool holds = light->error <= 1.1 * error;
    if (error > 0)
      p.limits.push_back({"--error", error, light->error, holds,
                          fmt::format("--error {:.3g} %: {:.3g} % predicted{}", 100 * error, 100 * light->error,
                                      holds ? ""
                                            : fmt::format(", {:.2g} times too much: rays are limited; a finer "
                                                          "--texel, or an --error that is named",
                                                          light->error / error))});
  }
  if (time <= 0) return;
  const double reached = light->error * std::sqrt(std::max(1.0, light->seconds / time));
  const bool holds = light->seconds <= time;
  p.limits.push_back(
      {"--time", time, light->seconds, holds,
       fmt::format("--time {:.4g} s: an error of {:.3g} % takes {:.3g} s{}", time, 100 * light->error, light->seconds,
                   holds ? std::string()
                         : fmt::format(", {:.2g} times too long; the error would be about {:.2g} %",
                                       light->seconds / time, 100 * reached))});
}

void add_memory_limit(const CensusInput& in, Prediction& p) {
  for (const Component& c : p.components) {
    if (c.raw_bytes == 0) continue;
    const auto most = static_cast<double>(in.options.planned.memory_bytes), wanted = static_cast<double>(c.raw_bytes);
    p.limits.push_back(
        {"--memory", most, wanted, wanted <= most,
         fmt::format("--memory {:.4g} MiB: maps that show everything sharp take {:.4g} MiB{}", most / 1048576,
                     wanted / 1048576, wanted <= most ? "" : fmt::format(", {:.2g} times too much", wanted / most))});
  }
}

}  // namespace

double TexelWork::at(double texels) const {
  return edges * std::sqrt(texels) + surfaces * texels;
}

TexelWork fit_work(const double (&n)[2], const double (&w)[2]) {
  const double r[2] = {std::sqrt(std::max(n[0], 1.0)), std::sqrt(std::max(n[1], 1.0))};
  const double per0 = w[0] / r[0], per1 = w[1] / r[1];  // edges + surfaces √n
  if (!(r[1] > r[0])) return {0, w[1] / (r[1] * r[1])};
  const double surfaces = (per1 - per0) / (r[1] - r[0]), edges = per0 - surfaces * r[0];
  // One of the two cannot be negative: the other alone, through the finer pilot.
  if (surfaces < 0) return {per1, 0};
  if (edges < 0) return {0, per1 / r[1]};
  return {edges, surfaces};
}

Result<Prediction> predict(const CensusInput& in, const Census& census, double spent, Context& context) {
  Prediction p;
  const ElapsedTime clock;
  const double plan_s = in.options.time_s > 0 ? std::min(kMostPlan_s, kMostOfTime * in.options.time_s) : kMostPlan_s;
  const double most = std::max(plan_s - spent, kLeastPilot * plan_s);
  p.components.push_back({.name = "preparation", .seconds = spent});
  const bool light = std::any_of(census.stages.begin(), census.stages.end(),
                                 [](const StageCensus& s) { return s.name == "radiosity" && s.runs; });
  if (light) {
    LightmapPilot pilots[2];
    const double coarser = std::clamp(std::sqrt(texels_of(in.prepared.texel_map) / kLeastPilotTexels), 1.0, kCoarser);
    for (int i = 0; i < 2; ++i) {
      const auto left = [&clock, until = kUntil[i] * most] { return until - clock.spent(); };
      ORIEL_TRY(pilots[i], bake_coarse(in, (2 - i) * coarser, left, context));
    }
    p.components.front().bytes = pilots[1].scene_bytes;
    p.components.push_back(extrapolate(in, pilots));
    if (in.options.with_radiance && !in.reflections.empty()) {
      const double left = std::max(most - clock.spent(), (1 - kUntil[1]) * most);
      ORIEL_TRY(Component radiance, predict_reflections(in, left, context));
      p.components.push_back(std::move(radiance));
    }
  }
  for (const Component& c : p.components) p.seconds += c.seconds, p.bytes += c.bytes;
  add_limits(in, p);
  add_memory_limit(in, p);
  p.pilot_seconds = clock.spent();
  return p;
}

}  // namespace oriel
