#include "bake/run/pipeline.h"

#include <algorithm>
#include <chrono>
#include <functional>

#include "bake/run/assemble.h"
#include "bake/run/report.h"
#include "bake/run/stages/inputs.h"
#include "bake/run/stages/movers.h"
#include "bake/run/stages/prepare.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

void warn_about_error(const BakeOptions& options, const RadiosityReport& report, Context& context) {
  const double asked = options.radiosity.error;
  if (asked <= 0 || options.time_s > 0 || report.ended_early || report.relative_error <= 1.25 * asked) return;
  context.warning(fmt::format(
      "the lightmap's stated error is {:.3g} %, asked for was {:.3g} %: some texels stay noisy at {} rays each, or lie "
      "where light changes within a texel; --texel makes those finer",
      100 * report.relative_error, 100 * asked, options.radiosity.samples));
}

// Whether refinement is to end: the user asks for it, or its time is over.
std::function<bool()> refined_enough(const BakeOptions& options, const Context& context) {
  using Clock = std::chrono::steady_clock;
  const bool limited = options.time_s > 0;
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                      std::chrono::duration<double>(limited ? options.time_s : 0));
  return [=, &finish = context.finish] { return finish || (limited && Clock::now() >= end); };
}

// Reflections, left out where the user wants the bake to finish.
Result<ReflectionReport> reflect(const BakeOptions& options, const BakedScene& baked, const MaterialMaps& materials,
                                 const AssembledMesh& mesh, Context& context, Pack& pack) {
  const Interruptible until(context, [&] { return context.finish.load(); });
  auto made = bake_reflections(options, baked, materials, mesh, context, pack);
  if (made || made.error().code != ErrorCode::kStopped || context.stop) return made;
  pack.emitters.clear();
  ReflectionReport none;
  none.omissions.emplace_back("radiance maps: left out, the user asked the bake to finish");
  return none;
}

}  // namespace

void warn_about_light(const Scene& scene, const LightSet& lights, Context& context) {
  if (lights.empty() && luminance(scene.sky) <= 0)
    context.warning("the scene has no light: no emissive material, no KHR_lights_punctual, no --sky; it is black");
}

Result<BakeResult> bake(const BakeOptions& options, Context& context) {
  BakeResult result;
  Stopwatch timed(result.times);
  ORIEL_TRY(PreparedScene prepared, prepare_scene(options, timed, context));
  ORIEL_TRY_VOID(lay_out_lightmap(options.atlas, timed, context, prepared));
  result.omissions = prepared.omissions;
  const Scene& scene = prepared.scene();
  const Accel& accel = *prepared.accel;
  const Atlas& atlas = prepared.atlas;
  const std::vector<TakenMover>& movers = prepared.movers;
  const LightSet lights(scene);
  warn_about_light(scene, lights, context);

  RadiosityOptions radiosity_options = options.radiosity;
  radiosity_options.enough = refined_enough(options, context);
  radiosity_options.directional = choose_directional(scene, options.directional, result.omissions);
  ORIEL_TRY(Radiosity radiosity, timed("radiosity", [&](std::uint64_t& rays) {
              const StageInputs inputs(context, SurfacesOf{scene}, LightsOf{scene}, LayoutOf{atlas},
                                       path_options(options).max_bounces);
              auto baked = bake_radiosity({accel, lights, path_options(options)}, atlas, prepared.texel_map,
                                          radiosity_options, context);
              if (baked) rays = baked->report.rays;
              return baked;
            }));
  result.radiosity = radiosity.report;
  context.finishable = true;
  warn_about_error(options, radiosity.report, context);
  Pack& pack = result.pack;
  pack.lightmaps = std::move(radiosity.pages);
  const BakedScene baked{accel, lights, atlas, pack.lightmaps};
  ORIEL_TRY(MaterialMaps materials, timed("material", [&](auto&) {
              const StageInputs inputs(context, std::string("material"));
              return bake_materials(scene, material_options(options), context);
            }));
  AssembledMesh mesh = assemble_mesh(scene, atlas);
  ReflectionReport reflections;
  if (options.with_radiance) {
    ORIEL_TRY(reflections, timed("radiance", [&](std::uint64_t& rays) {
                auto made = reflect(options, baked, materials, mesh, context, pack);
                if (made) rays = made->rays;
                return made;
              }));
    result.omissions.insert(result.omissions.end(), reflections.omissions.begin(), reflections.omissions.end());
  } else {
    result.omissions.emplace_back("radiance maps: left out by --only");
  }
  std::vector<MoverReport> mover_reports;
  if (!movers.empty()) {
    ORIEL_TRY(mover_reports, timed("transfer", [&](std::uint64_t& rays) {
                return bake_movers(options, movers, materials, context, pack, rays);
              }));
    ORIEL_TRY_VOID(timed(
        "probes", [&](std::uint64_t& rays) { return bake_light_field(options, baked, movers, context, pack, rays); }));
  } else if (options.with_transfer) {
    result.omissions.emplace_back("movers: no node is marked, animated or named by --mover");
  }
  if (!options.with_material) {
    result.omissions.emplace_back("kernels: left out by --only");
    materials.kernels.clear();
    for (auto& kernel : materials.kernel) kernel = -1;
  }
  assemble_materials(scene, materials, pack);
  pack.mesh = std::move(mesh.mesh);
  pack.kernels = std::move(materials.kernels);
  pack.fresnel_maps = std::move(materials.fresnel_maps);
  pack.split_reflectance = std::move(materials.split);
  pack.cameras = scene.cameras;
  pack.paths = scene.paths;
  pack.sky = scene.sky;
  if (context.stopped()) return fail(ErrorCode::kStopped, "bake", "stopped");
  pack.plan = plan_json({scene, atlas, prepared.sides, radiosity.report, pack, result.omissions, lights.power(),
                         reflections, mover_reports, options.radiosity.estimator == Estimator::kCached});
  pack.provenance = provenance_json(options, context.seed, prepared.imported->inputs);
  if (context.units) result.units = context.units->share();
  return result;
}

}  // namespace oriel
