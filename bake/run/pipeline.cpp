#include "bake/run/pipeline.h"

#include <algorithm>
#include <chrono>

#include "bake/jobs/parallel.h"
#include "bake/radiosity/lit_sides.h"
#include "bake/run/assemble.h"
#include "bake/run/report.h"
#include "bake/run/stages/movers.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

// Runs one stage and notes its wall clock.
class Stopwatch {
 public:
  explicit Stopwatch(std::vector<StageTime>& times) : times_(times) {}
  template <class Stage>
  auto operator()(const char* name, const Stage& stage) {
    const auto start = std::chrono::steady_clock::now();
    std::uint64_t rays = 0;
    auto result = stage(rays);
    times_.push_back({name, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), rays});
    return result;
  }

 private:
  std::vector<StageTime>& times_;
};

void warn_about_error(const BakeOptions& options, const RadiosityReport& report, Context& context) {
  const double asked = options.radiosity.error;
  if (asked <= 0 || options.time_s > 0 || report.relative_error <= 1.25 * asked) return;
  context.warning(fmt::format(
      "the lightmap's stated error is {:.3g} %, asked for was {:.3g} %: some texels stay noisy at {} rays each, or lie "
      "where light changes within a texel; --texel makes those finer",
      100 * report.relative_error, 100 * asked, options.radiosity.samples));
}

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

// Whether the lightmap is to hold directions; why not is noted.
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

struct LitScene {
  Accel accel;
  SidesReport sides;
};

// Splits the scene's double-sided surfaces by the light on their sides; its accelerator.
Result<LitScene> light_sides(const BakeOptions& options, Scene& scene, Stopwatch& timed, Context& context) {
  const auto build = [&](auto&) { return Accel::build(scene, {options.reproducible, thread_count(context)}); };
  ORIEL_TRY(Accel accel, timed("accelerator", build));
  ORIEL_TRY(const FoundSides found, timed("sides", [&](std::uint64_t& rays) {
              const LightSet lights(scene);
              auto sides = find_lit_sides({accel, lights, path_options(options)}, context);
              if (sides) rays = sides->report.rays;
              return sides;
            }));
  if (found.change_scene()) {
    scene = split_sides(std::move(scene), found.sides);
    ORIEL_TRY(accel, timed("accelerator", build));
  }
  return LitScene{std::move(accel), found.report};
}

}  // namespace

void warn_about_light(const Scene& scene, const LightSet& lights, Context& context) {
  if (lights.empty() && luminance(scene.sky) <= 0)
    context.warning("the scene has no light: no emissive material, no KHR_lights_punctual, no --sky; it is black");
}

Result<BakeResult> bake(const BakeOptions& options, Context& context) {
  BakeResult result;
  Stopwatch timed(result.times);
  ORIEL_TRY(ImportedScene imported,
            timed("import", [&](auto&) { return import_gltf(options.scene, options.import, context); }));
  std::vector<TakenMover> movers;
  if (options.with_transfer) {
    ORIEL_TRY(movers, take_movers(imported.scene));
  } else if (!imported.scene.movers.empty()) {
    result.omissions.emplace_back("movers: left out by --only; they stand still");
  }
  ORIEL_TRY(const LitScene lit, light_sides(options, imported.scene, timed, context));
  const Scene& scene = imported.scene;
  const Accel& accel = lit.accel;
  ORIEL_TRY(const Atlas atlas, timed("atlas", [&](auto&) { return build_atlas(scene, options.atlas, context); }));
  ORIEL_TRY(const auto texel_map, timed("texel map", [&](auto&) { return build_texel_map(atlas, context); }));
  const LightSet lights(scene);
  warn_about_light(scene, lights, context);

  RadiosityOptions radiosity_options = options.radiosity;
  if (options.time_s > 0) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(options.time_s);
    radiosity_options.enough = [end] { return std::chrono::steady_clock::now() >= end; };
  }
  radiosity_options.directional = choose_directional(scene, options.directional, result.omissions);
  ORIEL_TRY(Radiosity radiosity, timed("radiosity", [&](std::uint64_t& rays) {
              auto baked =
                  bake_radiosity({accel, lights, path_options(options)}, atlas, texel_map, radiosity_options, context);
              if (baked) rays = baked->report.rays;
              return baked;
            }));
  result.radiosity = radiosity.report;
  warn_about_error(options, radiosity.report, context);
  Pack& pack = result.pack;
  pack.lightmaps = std::move(radiosity.pages);
  ORIEL_TRY(MaterialMaps materials,
            timed("material", [&](auto&) { return bake_materials(scene, material_options(options), context); }));
  AssembledMesh mesh = assemble_mesh(scene, atlas);
  ReflectionReport reflections;
  if (options.with_radiance) {
    ORIEL_TRY(reflections, timed("radiance", [&](std::uint64_t& rays) {
                auto baked = bake_reflections(options, accel, atlas, materials, mesh, context, pack);
                if (baked) rays = baked->rays;
                return baked;
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
    ORIEL_TRY_VOID(timed("probes", [&](std::uint64_t& rays) {
      return bake_light_field(options, {accel, lights, atlas}, movers, context, pack, rays);
    }));
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
  pack.plan = plan_json({scene, atlas, lit.sides, radiosity.report, pack, result.omissions, lights.power(), reflections,
                         mover_reports, options.radiosity.estimator == Estimator::kCached});
  pack.provenance = provenance_json(options, context.seed, imported.inputs);
  return result;
}

}  // namespace oriel
