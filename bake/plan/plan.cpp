#include "bake/plan/plan.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>

namespace oriel {
namespace {

double seconds_of(const std::vector<StageTime>& times) {
  return std::accumulate(times.begin(), times.end(), 0.0,
                         [](double sum, const StageTime& t) { return sum + t.seconds; });
}

}  // namespace

Result<ScenePlan> make_plan(const BakeOptions& asked, bool with_pilot, Context& context) {
  ScenePlan plan;
  plan.scene = asked.scene.string();
  BakeOptions options = asked;
  std::vector<StageTime> times;
  Stopwatch timed(times);
  std::vector<Warning> warnings;
  const WarningLog log(context, warnings, false);
  ORIEL_TRY(PreparedScene prepared, prepare_scene(options, timed, context));
  const Scene& scene = prepared.scene();
  const std::size_t imported = warnings.size();
  ORIEL_TRY_VOID(lay_out_lightmap(options, timed, context, prepared));
  const auto of_atlas = [](const Warning& said) { return said.code == "uv1-faulty" || said.code == "uv1-moved"; };
  warnings.erase(
      std::remove_if(warnings.begin() + static_cast<std::ptrdiff_t>(imported), warnings.end(), std::not_fn(of_atlas)),
      warnings.end());
  plan.findings = findings_of_import(warnings);
  if (options.choose_texel) options.atlas.texel_m = prepared.atlas.texel_m;
  const LightSet lights(scene, &*prepared.accel);
  ORIEL_TRY(const MaterialMaps materials,
            timed("material", [&](auto&) { return bake_materials(scene, material_options(options), context); }));
  ORIEL_TRY(FoundReflections reflections, timed("reflectors", [&](auto&) {
              return find_reflections(options, prepared, materials.summaries, std::numeric_limits<double>::infinity(),
                                      context);
            }));
  // At most: which triangles each one shows takes longer to find out.
  const std::vector<std::uint64_t> triangles(reflections.found.reflectors.size(), scene.triangles.size());
  choose_ways(options.ways, options.target, triangles, reflections.found.reflectors);
  const ViewShares views = look_around(*prepared.accel, reflections.eyes, context.seed);
  const CensusInput input{options, prepared, lights, materials, reflections, views.front};
  plan.census = take_census(input);
  const double area_m2 = plan.census.area_m2;
  check_walls(scene, views, plan.findings);
  check_albedos(scene, materials.summaries, plan.findings);
  check_lights(scene, lights, area_m2, plan.findings);
  check_texels(scene, options.atlas, area_m2, plan.findings);
  std::stable_sort(plan.findings.begin(), plan.findings.end(),
                   [](const Finding& a, const Finding& b) { return a.kind < b.kind; });
  if (with_pilot) {
    ORIEL_TRY(plan.prediction, predict(input, plan.census, seconds_of(times), context));
  }
  return plan;
}

}  // namespace oriel
