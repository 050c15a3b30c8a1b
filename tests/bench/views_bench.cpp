// How much of what eyes see in reflectors planned radiance maps show, beside the paper's uniform hemispheres.
// Usage: views_bench SCENE.glb … [--maps N] [--hemisphere N] [--eyes N] [--samples N]
#include <algorithm>
#include <chrono>
#include <cstdio>

#include "bake/import/import.h"
#include "bake/material/materials.h"
#include "bake/radiance/planned_views.h"
#include "bake/visibility/eye_region.h"
#include "formats/cli/command.h"

namespace oriel {
namespace {

struct Settings {
  std::vector<std::string> scenes;
  std::uint32_t hemisphere = 64, eyes = 1000, samples = 4096;
  PlannedViewOptions plan;
};

// The same elements and resolutions, seen from hemispheres.
std::vector<RadianceMap> uniform_maps(const std::vector<RadianceMap>& planned, std::uint32_t count) {
  std::vector<RadianceMap> out;
  for (std::size_t i = 0; i < planned.size(); ++i) {
    if (i > 0 && planned[i].lower == planned[i - 1].lower && planned[i].upper == planned[i - 1].upper) continue;
    RadianceMap map = planned[i];
    const Vec2 middle = 0.5f * (map.lower + map.upper);
    for (const Vec3& direction : hemisphere_directions(count, {0.5 * kPiD, 0.5})) {
      map.eye = Vec3(middle, 0) + 0.5f * glm::length(map.upper - map.lower) * direction;
      out.push_back(map);
    }
  }
  return out;
}

Status print_reflector(const ReflectedSurroundings& surroundings, std::uint32_t r, const std::vector<RadianceMap>& maps,
                       std::span<const Vec3> eyes, const Settings& settings, Context& context) {
  const FoundReflector& found = surroundings.reflectors()[r];
  ORIEL_TRY(const auto samples,
            sample_reflections(surroundings, r, {eyes, settings.samples, context.seed + 1}, context));
  const ViewQuality planned = judge_maps(surroundings, maps, samples, context);
  const std::vector<RadianceMap> uniform = uniform_maps(maps, settings.hemisphere);
  const ViewQuality other = judge_maps(surroundings, uniform, samples, context);
  std::printf("| %.24s | %.3g | %.3g | %ux%u | %zu of %u | %.2f | %.1f | %zu | %.2f | %.1f |\n",
              found.reflector.name.c_str(), found.reflector.area_m2, found.roughness, found.reflector.elements_x,
              found.reflector.elements_y, maps.size(), maps.empty() ? 0 : std::max(maps[0].width, maps[0].height),
              100 * planned.seen, 100 * planned.sharp, uniform.size(), 100 * other.seen, 100 * other.sharp);
  std::fflush(stdout);
  return {};
}

Status run_scene(const std::string& path, const Settings& settings) {
  Context context;
  ORIEL_TRY(const ImportedScene imported, import_gltf(path, {}, context));
  const Scene& scene = imported.scene;
  ORIEL_TRY(const Accel accel, Accel::build(scene));
  std::vector<ReflectorMaterial> materials;
  for (const MaterialSummary& m : summarize_materials(scene)) materials.push_back({m.roughness, m.f0, m.f90, m.curve});
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  ORIEL_TRY(const EyeRegion region, find_eye_region(accel, {}, context));
  const double walk_s = seconds();
  const std::vector<Vec3> training = sample_eyes(region, 4096, context.seed),
                          held_out = held_out_eyes(region, settings.eyes, context.seed);
  FoundReflectors found = find_reflectors(accel, materials);
  ORIEL_TRY_VOID(keep_seen_reflectors(accel, training, 32, context, found));
  std::vector<FoundReflector> reflectors = found.reflectors;
  const ReflectedSurroundings surroundings(accel, found.reflectors, {});
  PlannedViewOptions views = settings.plan;
  views.eyes = training;
  ORIEL_TRY(ViewPlan plan, plan_views_for_eyes(surroundings, views, context, reflectors));
  const double planned_s = seconds();
  std::printf("\n%s: %zu storeys, walk %.2f s, planned in %.2f s\n", path.c_str(), region.grids.size(), walk_s,
              planned_s - walk_s);
  for (const std::string& line : plan.omitted) std::printf("%s\n", line.c_str());
  std::printf(
      "| reflector | m² | roughness | elements | maps | seen %% | sharp %% | uniform maps | seen %% "
      "| sharp %% |\n");
  std::printf("|---|---|---|---|---|---|---|---|---|---|\n");
  for (std::uint32_t r = 0; r < reflectors.size(); ++r) {
    found.reflectors[r] = reflectors[r];
    const auto first = plan.maps.begin() + reflectors[r].reflector.first_map;
    ORIEL_TRY_VOID(print_reflector(surroundings, r, {first, first + reflectors[r].reflector.map_count}, held_out,
                                   settings, context));
  }
  return {};
}

int run(int argc, char** argv) {
  Settings settings;
  settings.plan.memory_bytes = std::uint64_t{1} << 40;
  if (const auto code = parse_options(
          argc, argv, "What planned radiance maps show, beside uniform hemispheres.",
          {{"SCENE", "Arguments", ".glb or .gltf files", texts(settings.scenes, "SCENE"), Use::kRequired},
           {"--maps", "Options", "Planned for an element", number(settings.plan.choice.max_maps, 0, 4096)},
           {"--hemisphere", "Options", "Uniform maps of an element", number(settings.hemisphere, 0, 4096)},
           {"--eyes", "Options", "Held out from planning", number(settings.eyes, 0, 1e9)},
           {"--samples", "Options", "Reflected rays to judge by", number(settings.samples, 0, 1e9)},
           {"--elements", "Options", "Of a reflector at most", number(settings.plan.max_elements, 1, 1e6)}}))
    return *code;
  for (const std::string& scene : settings.scenes)
    if (const Status status = run_scene(scene, settings); !status) {
      std::fprintf(stderr, "views_bench: %s\n", status.error().text().c_str());
      return 1;
    }
  return 0;
}

}  // namespace
}  // namespace oriel

int main(int argc, char** argv) {
  return oriel::run(argc, argv);
}
