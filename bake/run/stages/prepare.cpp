#include "bake/run/stages/prepare.h"

#include <algorithm>

#include "bake/jobs/parallel.h"
#include "bake/jobs/units.h"
#include "bake/run/stages/inputs.h"

namespace oriel {
namespace {

// Splits the scene's double-sided surfaces by the light on their sides, and fills `prepared.accel`.
Status light_sides(const BakeOptions& options, PreparedScene& prepared, Stopwatch& timed, Context& context) {
  Scene& scene = prepared.imported->scene;
  const auto build = [&](auto&) { return Accel::build(scene, {options.reproducible, thread_count(context)}); };
  ORIEL_TRY(prepared.accel, timed("accelerator", build));
  ORIEL_TRY(const FoundSides found, timed("sides", [&](std::uint64_t& rays) {
              const LightSet lights(scene);
              const StageInputs inputs(context, SurfacesOf{scene}, LightsOf{scene}, path_options(options).max_bounces);
              auto sides = find_lit_sides({*prepared.accel, lights, path_options(options)}, context);
              if (sides) rays = sides->report.rays;
              return sides;
            }));
  prepared.sides = found.report;
  if (!found.change_scene()) return {};
  scene = split_sides(std::move(scene), found.sides);
  ORIEL_TRY(prepared.accel, timed("accelerator", build));
  return {};
}

}  // namespace

PathOptions path_options(const BakeOptions& options) {
  PathOptions paths;
  if (options.radiosity.bounces > 0) paths.max_bounces = options.radiosity.bounces;
  return paths;
}

MaterialOptions material_options(const BakeOptions& options) {
  MaterialOptions material = options.material;
  if (options.radiosity.error > 0) material.error = options.radiosity.error;
  return material;
}

bool choose_directional(const Scene& scene, Directional wanted, std::vector<std::string>& omissions) {
  if (wanted == Directional::kOn) return true;
  const bool mapped = std::any_of(scene.surfaces.begin(), scene.surfaces.end(), [&](const Surface& surface) {
    const SceneMaterial& material = scene.materials[surface.material];
    return material.normal_texture.image >= 0 && !material.unlit;
  });
  if (mapped && wanted == Directional::kAuto) return true;
  omissions.emplace_back(mapped
                             ? "directional lightmaps: left out by --directional off; normal maps tilt reflections only"
                             : "directional lightmaps: no material has a normal map");
  return false;
}

Result<PreparedScene> prepare_scene(const BakeOptions& options, Stopwatch& timed, Context& context) {
  PreparedScene prepared;
  ORIEL_TRY(ImportedScene imported,
            timed("import", [&](auto&) { return import_gltf(options.scene, options.import, context); }));
  prepared.imported = std::make_unique<ImportedScene>(std::move(imported));
  Scene& scene = prepared.imported->scene;
  if (options.with_transfer) {
    ORIEL_TRY(prepared.movers, take_movers(scene));
  } else if (!scene.movers.empty()) {
    prepared.omissions.emplace_back("movers: left out by --only; they stand still");
  }
  ORIEL_TRY_VOID(light_sides(options, prepared, timed, context));
  return prepared;
}

Status lay_out_lightmap(const AtlasOptions& options, Stopwatch& timed, Context& context, PreparedScene& prepared) {
  ORIEL_TRY(prepared.atlas, timed("atlas", [&](auto&) { return build_atlas(prepared.scene(), options, context); }));
  ORIEL_TRY(prepared.texel_map, timed("texel map", [&](auto&) { return build_texel_map(prepared.atlas, context); }));
  return {};
}

}  // namespace oriel
