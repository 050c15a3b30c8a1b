#include "bake/run/pipeline.h"

#include <algorithm>
#include <functional>
#include <optional>

#include "bake/run/assemble.h"
#include "bake/run/report.h"
#include "bake/run/stages/deadline.h"
#include "bake/run/stages/inputs.h"
#include "bake/run/stages/movers.h"
#include "bake/run/stages/prepare.h"
#include "bake/run/stages/visibility.h"
#include "bake/run/start.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr double kMostForAtlas = 0.2;       // of the time that is left, for charts that are more than plain
constexpr double kMostForViews = 0.15;      // of the same, for choosing viewpoints
constexpr double kMostForSets = 0.2;        // of the same, for visible sets
constexpr double kMostForTiming = 0.1;      // of the same, for finding out how long capture takes
constexpr double kMostForMaps = 0.5;        // of the time that is left when the lightmap begins
constexpr double kMostForField = 0.2;       // of the same, kept for the light field of movers
constexpr double kUnlooked = 1.3;           // times longer than foretold, for which time is kept
constexpr double kSlowPaths = 1.5;          // a ray of verification takes longer than a gathered one
constexpr double kLedgerRays = 0.01;        // of the lightmap's
constexpr double kWritten_per_s = 25e6;     // bytes of maps and lightmaps that a pack takes in
constexpr std::uint32_t kEyes = 1024;       // by which the lightmap's error is told, and as many that verify it
constexpr double kLate_s = 2, kLate = 0.1;  // by which --time may be missed

void warn_about_error(const BakeOptions& options, const RadiosityReport& report, const Deadline& deadline,
                      Context& context) {
  const double asked = options.radiosity.error, stated = report.relative_error;
  const Certificate& c = report.certificate;
  if (asked <= 0 || context.finish) return;
  if (c.error_low > kUnlooked * std::max(asked, stated))
    context.warning(
        fmt::format("held-out pixels are {:.3g} % off ({:.3g} to {:.3g} %), where {:.3g} % was asked for and {:.3g} % "
                    "is stated: light "
                    "varies more within texels than they tell; --texel makes those finer",
                    100 * c.relative_error, 100 * c.error_low, 100 * c.error_high, 100 * asked, 100 * stated));
  if (stated <= 1.25 * asked) return;
  if (report.ended_early && deadline.limited() && asked > kBestError)
    context.warning(
        fmt::format("--error {:.3g} % was not reached within --time {:.4g} s: the lightmap's stated error is "
                    "{:.3g} %, {:.2g} times too much",
                    100 * asked, options.time_s, 100 * stated, stated / asked));
  if (report.ended_early) return;
  if (report.out_of_rays) {
    context.warning(fmt::format(
        "the lightmap's stated error is {:.3g} %: the default of {:.3g} % takes more than a bake's first minutes; "
        "--error {:.3g}% goes on until it is there",
        100 * stated, 100 * asked, 100 * asked));
    return;
  }
  context.warning(fmt::format(
      "the lightmap's stated error is {:.3g} %, asked for was {:.3g} %: some texels stay noisy at {} rays each, or lie "
      "where light changes within a texel; --texel makes those finer",
      100 * stated, 100 * asked, options.radiosity.samples));
}

void warn_about_time(const BakeOptions& options, const Deadline& deadline, const std::vector<StageTime>& times,
                     Context& context) {
  if (!deadline.limited() || deadline.spent() <= options.time_s + std::max(kLate_s, kLate * options.time_s)) return;
  const auto longest = std::max_element(times.begin(), times.end(),
                                        [](const StageTime& a, const StageTime& b) { return a.seconds < b.seconds; });
  context.warning(
      fmt::format("--time {:.4g} s was missed by {:.3g} s: '{}' alone took {:.3g} s, its first estimate cannot "
                  "end earlier; a larger --texel takes less",
                  options.time_s, deadline.spent() - options.time_s, longest->stage, longest->seconds));
}

double bytes_of(const Pack& pack, const PlannedReflections& planned) {
  double bytes = 0;
  for (const LightmapPage& page : pack.lightmaps) bytes += 8.0 * static_cast<double>(page.irradiance.size());
  for (const RadianceMap& map : planned.plan.maps) bytes += double{kMapBytesPerPixel} * map.width * map.height;
  return bytes;
}

// Whether refinement of the lightmap is to end: the user asks for it, or what is left is what later stages need.
// `later`: seconds of these.
std::function<bool()> refined_enough(const BakeOptions& options, const Deadline& deadline, double later,
                                     const Context& context) {
  const double verifying = kSlowPaths * options.radiosity.verify;
  return [=, &deadline, &finish = context.finish, begun = deadline.spent()] {
    return finish || deadline.left() <= later + verifying * (deadline.spent() - begun);
  };
}

// Maps as large as the time allows; the seconds that all stages behind the lightmap are likely to take.
Result<double> fit_reflections(const BakeOptions& options, const PreparedScene& prepared, const LightSet& lights,
                               const Deadline& deadline, Context& context, PlannedReflections& planned) {
  Pack dark;
  for (const AtlasPage& page : prepared.atlas.pages) {
    const std::size_t texels = std::size_t{page.width} * page.height;
    dark.lightmaps.push_back({page.width, page.height, std::vector<Vec3>(texels), {}, {}});
  }
  if (!planned.empty()) {
    const double until = deadline.left() * (1 - kMostForTiming);
    const auto late = [&] { return deadline.left() < until; };
    Status tried;
    {
      const Interruptible interruptible(context, late);
      tried = time_capture(options, {*prepared.accel, lights, prepared.atlas, dark.lightmaps}, context, planned);
    }
    if (!tried && (context.stop || !late())) return tl::unexpected(tried.error());
    if (!tried) leave_out_maps("a few of their pixels already take too long for --time", planned);
    shrink_maps(kMostForMaps * deadline.left(), planned);
  }
  const double field = prepared.movers.empty() ? 0 : kMostForField * std::max(0.0, deadline.left());
  return kUnlooked * (planned.capture_s + bytes_of(dark, planned) / kWritten_per_s) + field;
}

// What a stage makes that the bake can do without: none where --time is over before, or the user wants to finish.
template <class Stage>
auto unless_late(const Deadline& deadline, Context& context, const Stage& stage)
    -> Result<std::optional<std::decay_t<decltype(*stage())>>> {
  const auto late = [&] { return context.finish || deadline.left() <= 0; };
  const Interruptible until(context, late);
  auto made = stage();
  if (made) return std::optional(std::move(*made));
  if (made.error().code == ErrorCode::kStopped && late() && !context.stop) return std::nullopt;
  return tl::unexpected(made.error());
}

// Reflections, left out where the user or the time wants the bake to finish.
Result<ReflectionReport> reflect(const BakeOptions& options, PlannedReflections planned, const BakedScene& baked,
                                 const MaterialMaps& materials, const AssembledMesh& mesh, const Deadline& deadline,
                                 Context& context, Pack& pack) {
  const double writing = deadline.limited() ? bytes_of(pack, {}) / kWritten_per_s : 0;
  const Interruptible until(context, [&] { return context.finish || deadline.left() <= writing; });
  auto made = bake_reflections(options, std::move(planned), baked, materials, mesh, context, pack);
  if (made || made.error().code != ErrorCode::kStopped || context.stop) return made;
  pack.emitters.clear();
  ReflectionReport none;
  none.omissions.push_back(fmt::format("radiance maps: left out, {}",
                                       context.finish ? "the user asked the bake to finish" : "--time was over"));
  return none;
}

void leave_out_kernels(MaterialMaps& materials, std::vector<std::string>& omissions) {
  omissions.emplace_back("kernels: left out by --only");
  materials.kernels.clear();
  for (auto& kernel : materials.kernel) kernel = -1;
}

// Samples that were left out, and where to look for the cause.
void tell_dropped(const Accel& accel, std::vector<std::string>& findings) {
  const DroppedSamples& dropped = accel.dropped();
  if (dropped.count() == 0) return;
  std::string place = "far from any surface";
  if (const std::uint32_t t = dropped.first_triangle(); t != DroppedSamples::kNowhere) {
    const Surface& surface = accel.scene().surfaces[accel.scene().triangle_surface[t]];
    place = fmt::format("first at triangle {} of '{}', material '{}'", t - surface.first_triangle, surface.name,
                        accel.scene().materials[surface.material].name);
  }
  findings.push_back(fmt::format("{} samples of light are left out, which are no numbers: {}", dropped.count(), place));
}

void fill_pack(const Scene& scene, MaterialMaps materials, AssembledMesh mesh, Pack& pack) {
  assemble_materials(scene, materials, pack);
  pack.mesh = std::move(mesh.mesh);
  pack.kernels = std::move(materials.kernels);
  pack.fresnel_maps = std::move(materials.fresnel_maps);
  pack.split_reflectance = std::move(materials.split);
  pack.cameras = scene.cameras;
  pack.paths = scene.paths;
  pack.sky = scene.sky;
}

}  // namespace

void warn_about_light(const Scene& scene, const LightSet& lights, Context& context) {
  if (lights.empty() && luminance(scene.sky) <= 0)
    context.warning("the scene has no light: no emissive material, no KHR_lights_punctual, no --sky; it is black");
}

Result<BakeResult> bake(const BakeOptions& options, Context& context) {
  BakeResult result;
  const Deadline deadline(options.time_s);
  Stopwatch timed(result.times);
  ORIEL_TRY(PreparedScene prepared, prepare_scene(options, timed, context));
  BakeOptions layout = options;
  if (deadline.limited() && layout.atlas.time_limit_s <= 0)
    layout.atlas.time_limit_s = kMostForAtlas * std::max(deadline.left(), kLate * options.time_s);
  ORIEL_TRY_VOID(lay_out_lightmap(layout, timed, context, prepared, deadline.left()));
  result.omissions = prepared.omissions;
  const Scene& scene = prepared.scene();
  const Accel& accel = *prepared.accel;
  const Atlas& atlas = prepared.atlas;
  const std::vector<TakenMover>& movers = prepared.movers;
  const LightSet lights(scene);
  warn_about_light(scene, lights, context);

  // What needs no light comes first: what it takes is known when the lightmap asks how long it may be refined.
  Pack& pack = result.pack;
  ORIEL_TRY(MaterialMaps materials, timed("material", [&](auto&) {
              const StageInputs inputs(context, std::string("material"));
              return bake_materials(scene, material_options(options), context);
            }));
  PlannedReflections planned;
  if (options.with_radiance) {
    ORIEL_TRY(planned, timed("views", [&](auto&) {
                return plan_reflections(options, prepared, lights, materials, kMostForViews * deadline.left(), context);
              }));
  }
  if (!planned.empty())
    ORIEL_TRY_VOID(timed("mips", [&](auto&) { return make_mips(prepared.imported->scene, context); }));
  AssembledMesh mesh = assemble_mesh(scene, atlas);
  VisibilityReport visibility;
  ORIEL_TRY(pack.visible_sets, timed("visibility", [&](std::uint64_t& rays) {
              auto sets = bake_visibility(options, accel, planned.all.region.grids, mesh,
                                          kMostForSets * deadline.left(), context, visibility, result.omissions);
              rays += visibility.lines;
              return sets;
            }));
  std::vector<MoverReport> mover_reports;
  if (!movers.empty()) {
    ORIEL_TRY(mover_reports, timed("transfer", [&](std::uint64_t& rays) {
                return bake_movers(options, movers, materials, context, pack, rays);
              }));
  }
  double later = 0;
  if (deadline.limited()) {
    ORIEL_TRY(later, timed("timing", [&](auto&) {
                return fit_reflections(options, prepared, lights, deadline, context, planned);
              }));
  }

  RadiosityOptions radiosity_options = options.radiosity;
  radiosity_options.enough = refined_enough(options, deadline, later, context);
  if (deadline.limited()) radiosity_options.left = [&, later] { return deadline.left() - later; };
  radiosity_options.directional = choose_directional(scene, options.directional, result.omissions);
  radiosity_options.eyes = sample_eyes(prepared.region, kEyes, context.seed);
  radiosity_options.held_out = held_out_eyes(prepared.region, kEyes, context.seed);
  ORIEL_TRY(Radiosity radiosity, timed("radiosity", [&](std::uint64_t& rays) {
              const StageInputs inputs(context, SurfacesOf{scene}, LightsOf{scene}, LayoutOf{atlas},
                                       path_options(options).max_bounces);
              auto baked = bake_radiosity({accel, lights, path_options(options)}, atlas, prepared.texel_map,
                                          radiosity_options, context);
              if (baked) rays = baked->report.rays;
              return baked;
            }));
  result.radiosity = radiosity.report;
  planned.light_reused = radiosity.report.reuse.kept > 0;
  context.finishable = true;
  warn_about_error(options, radiosity.report, deadline, context);
  ORIEL_TRY(auto ledger, timed("ledger", [&](std::uint64_t& rays) {
              const auto at_most = static_cast<std::uint64_t>(kLedgerRays * static_cast<double>(radiosity.report.rays));
              auto kept = unless_late(deadline, context, [&] {
                return keep_ledger({accel, lights, path_options(options)}, atlas, prepared.texel_map, radiosity,
                                   at_most, context);
              });
              if (kept && *kept) rays = (*kept)->rays;
              return kept;
            }));
  if (!ledger) result.omissions.emplace_back("energy ledger: left out, --time was over");
  result.ledger = ledger.value_or(Ledger());
  result.findings = ledger_findings(result.ledger);
  pack.lightmaps = std::move(radiosity.pages);
  const BakedScene baked{accel, lights, atlas, pack.lightmaps};
  ReflectionReport reflections;
  if (options.with_radiance) {
    ORIEL_TRY(reflections, timed("radiance", [&](std::uint64_t& rays) {
                auto made = reflect(options, std::move(planned), baked, materials, mesh, deadline, context, pack);
                if (made) rays = made->rays;
                return made;
              }));
    result.map_reuse = reflections.reuse;
    result.omissions.insert(result.omissions.end(), reflections.omissions.begin(), reflections.omissions.end());
  } else {
    result.omissions.emplace_back("radiance maps: left out by --only");
  }
  if (!movers.empty()) {
    std::atomic<bool> late{false};
    const double writing = bytes_of(pack, {}) / kWritten_per_s;
    const auto enough = [&] {
      if (context.finish || deadline.left() <= writing) late = true;
      return late.load();
    };
    ORIEL_TRY_VOID(timed("probes", [&](std::uint64_t& rays) {
      return bake_light_field(options, baked, movers, enough, context, pack, rays);
    }));
    if (late) result.omissions.emplace_back("light field: its last refinement is left out, the bake was to end");
  } else if (options.with_transfer) {
    result.omissions.emplace_back("movers: no node is marked, animated or named by --mover");
  }
  if (!options.with_material) leave_out_kernels(materials, result.omissions);
  fill_pack(scene, std::move(materials), std::move(mesh), pack);
  ORIEL_TRY(const Start start, choose_start(options, prepared.region, baked, context, pack));
  if (!pack.visible_sets.empty())
    pack.visible_sets.made_for = visibility_hash(pack.mesh, pack.materials, pack.walk_grids);
  if (context.stopped()) return fail(ErrorCode::kStopped, "bake", "stopped");
  ORIEL_TRY_VOID(timed("checks", [&](auto&) { return leave_out_unsound(pack, result.left_out); }));
  result.omissions.insert(result.omissions.end(), result.left_out.begin(), result.left_out.end());
  tell_dropped(accel, result.findings);
  for (const std::string& finding : result.findings) context.warning(finding);
  pack.plan =
      plan_json({scene, atlas, prepared.sides, radiosity.report, result.ledger, pack, result.omissions, lights.power(),
                 reflections, mover_reports, visibility, options.radiosity.estimator == Estimator::kCached,
                 options.radiosity.error, start, result.findings});
  pack.provenance = provenance_json(options, context.seed, prepared.imported->inputs);
  warn_about_time(options, deadline, result.times, context);
  if (context.units) result.units = context.units->share();
  return result;
}

}  // namespace oriel
