#include "bake/run/prepare.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "bake/jobs/parallel.h"
#include "bake/jobs/units.h"
#include "bake/run/inputs.h"
#include "bake/visibility/divide.h"
#include "bake/visibility/eye_height.h"
#include "bake/visibility/lit_eyes.h"
#include "bake/visibility/scene_unit.h"
#include "bake/visibility/wall_cuts.h"
#include "formats/core/color.h"
#include "formats/core/text.h"

namespace oriel {
namespace {

constexpr std::uint32_t kEyesForSides = 256;
constexpr double kTriangles_per_s = 1e5;     // of --time: reading, tracing, laying out and writing take 3 to 6 µs each
constexpr double kMostForWalls = 0.1;        // of --time: 400 thousand facets of a terrain take 5 s of a thread
constexpr double kMostForSides = 0.15;       // of --time
constexpr double kMostForFirstLight = 0.18;  // of what of it is left when the lightmap is laid out
constexpr double kFirstRays = 800;      // of a texel, for a first estimate of its light: points, direct light, gather
constexpr double kViewRays = 6e5;       // that tell what people see, by which a ray's time is told;
constexpr double kLeastRay_s = 1e-7;    // which says nothing where they were known already
constexpr double kBouncesASecond = 32;  // of --time

Status build_accel(const BakeOptions& options, Stopwatch& timed, Context& context, PreparedScene& prepared) {
  ORIEL_TRY(prepared.accel, timed("accelerator", [&](auto&) {
              return Accel::build(prepared.scene(), {options.reproducible, thread_count(context)});
            }));
  return {};
}

// Imports the scene, takes its movers and builds the accelerator.
Status import_scene(const BakeOptions& options, double unit_m, Stopwatch& timed, Context& context,
                    PreparedScene& prepared) {
  ImportOptions import = options.import;
  import.unit_m = unit_m;
  import.most_triangles = static_cast<std::uint64_t>(kTriangles_per_s * options.time_s);
  prepared.accel.reset();
  ORIEL_TRY(ImportedScene imported,
            timed("import", [&](auto&) { return import_gltf(options.scene, import, context); }));
  prepared.imported = std::make_unique<ImportedScene>(std::move(imported));
  if (options.with_transfer) {
    ORIEL_TRY(prepared.movers, take_movers(prepared.imported->scene));
  }
  return build_accel(options, timed, context, prepared);
}

// What people are, see and walk is in metres.
Status settle_unit(const BakeOptions& options, Stopwatch& timed, Context& context, PreparedScene& prepared) {
  const auto unit_m = guessed_unit(*prepared.accel, options.import.unit_m, context);
  if (!unit_m) {
    const std::string ending = lower_case(options.scene.extension().string());
    const Vec3 m = prepared.scene().upper - prepared.scene().lower;
    if (ending == ".obj" || ending == ".3ds" || ending == ".ply" || ending == ".stl")
      context.warning("unit-guessed", fmt::format("the file tells no unit: it is taken to be {:.3g} x {:.3g} x {:.3g} "
                                                  "m large; --unit cm (mm, in, ft, m) tells it",
                                                  m.x, m.y, m.z));
    return {};
  }
  prepared.unit_guessed = true;
  auto warn = std::exchange(context.warn, nullptr);  // all was said before
  const Status again = import_scene(options, *unit_m, timed, context, prepared);
  context.warn = std::move(warn);
  return again;
}

// How tall the people are who walk here: as the user says, or as the file tells.
void settle_eye_height(const BakeOptions& options, bool unit_guessed, Context& context, PreparedScene& prepared) {
  prepared.walk = options.eyes.walk;
  const float usual = prepared.walk.eye_height_m;
  if (!options.guess_eye_height) {
    prepared.walk = prepared.walk.scaled(options.eye_height_m / usual);
    return;
  }
  const auto told = guess_eye_height(*prepared.accel, unit_guessed);
  if (!told) return;
  prepared.walk = prepared.walk.scaled(told->eye_height_m / usual);
  context.warning(
      "eyes-guessed",
      fmt::format("people's eyes are taken to be {:.2f} m over the floor, not {:.1f} m, and their steps and reach to "
                  "go with it: "
                  "{} "
                  "in rooms typically {:.2f} m high; --eye-height {:.1f}m keeps people of usual size, --unit tells "
                  "another unit",
                  told->eye_height_m, usual,
                  told->cameras > 0 ? fmt::format("the scene's {} viewpoints are as high as that", told->cameras)
                                    : std::string("without a camera"),
                  told->room_height_m, usual));
}

// Where people can be, and pieces of what they see both near and far.
Status find_eyes(const BakeOptions& options, Stopwatch& timed, Context& context, PreparedScene& prepared) {
  EyeOptions eyes = options.eyes;
  eyes.walk = prepared.walk;
  ORIEL_TRY(prepared.region, timed("eyes", [&](auto&) { return find_eye_region(*prepared.accel, eyes, context); }));
  const LightSet lights(prepared.scene(), &*prepared.accel);
  if (options.eyes.source == EyeSource::kWalk)
    ORIEL_TRY_VOID(stand_around_bodies(*prepared.accel, prepared.region, context));
  if (options.eyes.source == EyeSource::kWalk && (!lights.empty() || luminance(prepared.scene().sky) > 0))
    ORIEL_TRY_VOID(leave_the_dark({*prepared.accel, lights, path_options(options)}, prepared.region, context));
  if (!prepared.region.note.empty()) prepared.omissions.push_back(prepared.region.note);
  if (prepared.region.left_out_m2 > 0)
    prepared.omissions.push_back(fmt::format(
        "eye region: {:.0f} m² of open ground are not walked on, where neither a roof nor a camera is near (--eyes)",
        prepared.region.left_out_m2));
  if (!divide_for_eyes(prepared.region, prepared.imported->scene)) return {};
  return build_accel(options, timed, context, prepared);
}

// What a bake needs beside its texels: the scene, its accelerator and what is known of its triangles, its maps.
std::uint64_t bytes_besides_texels(const BakeOptions& options, const Scene& scene) {
  constexpr std::uint64_t kProgram = 100u << 20, kVertex = 64, kTriangle = 400;
  std::uint64_t bytes = kProgram + kVertex * scene.positions.size() + kTriangle * scene.triangles.size();
  for (const Image& image : scene.images) bytes += image.texels.size() * (options.with_radiance ? 4 : 3) / 3;
  // Radiance maps are captured in floats, twice as large as they are stored, beside what is stored.
  return bytes + (options.with_radiance ? 3 * options.planned.memory_bytes : 0);
}

// Cuts floors, ceilings and walls under the walls that stand on them.
Status part_rooms(const BakeOptions& options, Stopwatch& timed, Context& context, PreparedScene& prepared) {
  if (options.atlas.source == AtlasOptions::Source::kUv1) return {};
  Scene& scene = prepared.imported->scene;
  ORIEL_TRY(scene.cuts, timed("walls", [&](auto&) {
              const ElapsedTime clock;
              const Interruptible until(
                  context, [&] { return options.time_s > 0 && clock.spent() > kMostForWalls * options.time_s; });
              return find_wall_cuts(*prepared.accel, prepared.walk.size(), context);
            }));
  if (!cut_triangles(scene)) return {};
  return build_accel(options, timed, context, prepared);
}

// Splits the scene's double-sided surfaces by the light on their sides.
Status light_sides(const BakeOptions& options, PreparedScene& prepared, Stopwatch& timed, Context& context) {
  Scene& scene = prepared.imported->scene;
  const LightSet lights(scene, &*prepared.accel);
  if (lights.empty() && luminance(scene.sky) <= 0) return {};  // nothing is lit
  ORIEL_TRY(const FoundSides found, timed("sides", [&](std::uint64_t& rays) {
              const StageInputs inputs(context, SurfacesOf{scene}, LightsOf{scene}, path_options(options).max_bounces);
              const ElapsedTime clock;
              const Interruptible until(
                  context, [&] { return options.time_s > 0 && clock.spent() > kMostForSides * options.time_s; });
              const std::vector<Vec3> eyes = sample_eyes(prepared.region, kEyesForSides, context.seed);
              auto sides = find_lit_sides({*prepared.accel, lights, path_options(options)}, eyes, context);
              if (sides) rays = sides->report.rays;
              return sides;
            }));
  prepared.sides = found.report;
  if (!found.change_scene()) return {};
  scene = split_sides(std::move(scene), found.sides);
  return build_accel(options, timed, context, prepared);
}

}  // namespace

PathOptions path_options(const BakeOptions& options) {
  PathOptions paths;
  // Between mirrors that reflect all, each path is as long as it may be, and no task may take most of the time.
  if (const double most = kBouncesASecond * options.time_s; options.time_s > 0 && most < paths.max_bounces)
    paths.max_bounces = std::bit_ceil(static_cast<unsigned>(std::max(most, kBouncesASecond)));
  if (options.radiosity.bounces > 0) paths.max_bounces = options.radiosity.bounces;
  return paths;
}

MaterialOptions material_options(const BakeOptions& options) {
  MaterialOptions material = options.material;
  if (options.radiosity.error > 0) material.error = options.radiosity.error;
  return material;
}

bool choose_directional(const Scene& scene, Directional wanted, std::vector<Warning>& omissions) {
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

double PreparedScene::texels() const {
  double sum = 0;
  for (const TexelMapPage& page : texel_map) sum += static_cast<double>(page.texel.size());
  return sum;
}

bool PreparedScene::wants_light_field() const {
  const auto& groups = scene().light_groups;
  return !movers.empty() || std::ranges::any_of(scene().lights, [&](const Light& light) {
    return !groups.empty() && groups[light.light_group].motion >= 0;
  });
}

std::optional<double> guessed_unit(const Accel& accel, double unit_m, Context& context) {
  const auto guess = guess_unit(accel);
  if (!guess) return std::nullopt;
  if (guess->metres == 1) {
    context.warning(
        "unit-guessed",
        fmt::format("the scene's rooms are typically {:.3g} m high, as a storey is in feet, and no camera tells: they "
                    "stay metres; --unit ft takes the file's numbers as feet, --unit m says that they are metres",
                    guess->room_height * unit_m));
    return std::nullopt;
  }
  context.warning(
      "unit-guessed",
      fmt::format("the scene's rooms are typically {:.3g} m high, and a person of 1.8 m stands in none: one unit of "
                  "the file is taken to be {:g} m, light on surfaces stays what it is; --unit m keeps metres",
                  guess->room_height * unit_m, guess->metres * unit_m));
  return guess->metres * unit_m;
}

Result<PreparedScene> prepare_scene(const BakeOptions& options, Stopwatch& timed, Context& context) {
  PreparedScene prepared;
  ORIEL_TRY_VOID(import_scene(options, options.import.unit_m, timed, context, prepared));
  if (options.guess_unit) ORIEL_TRY_VOID(settle_unit(options, timed, context, prepared));
  if (!options.with_transfer && !prepared.scene().movers.empty())
    prepared.omissions.emplace_back("movers: left out by --only; they stand still");
  settle_eye_height(options, prepared.unit_guessed, context, prepared);
  ORIEL_TRY_VOID(find_eyes(options, timed, context, prepared));
  ORIEL_TRY_VOID(part_rooms(options, timed, context, prepared));
  ORIEL_TRY_VOID(light_sides(options, prepared, timed, context));
  return prepared;
}

Status lay_out_lightmap(const BakeOptions& options, Stopwatch& timed, Context& context, PreparedScene& prepared,
                        double seconds) {
  const ElapsedTime clock;
  if (prepared.demand.empty()) {
    const StageInputs inputs(context, SurfacesOf{prepared.scene()});
    ORIEL_TRY(prepared.demand,
              timed("importance", [&](auto&) { return find_demand(*prepared.accel, prepared.region, context); }));
  }
  AtlasOptions atlas = options.atlas;
  if (options.memory_bytes > 0) {
    const std::uint64_t other = bytes_besides_texels(options, prepared.scene());
    atlas.memory_bytes =
        std::max(options.memory_bytes / 4, options.memory_bytes - std::min(options.memory_bytes, other));
  }
  if (options.choose_texel) {
    atlas.texel_m = choose_texel(prepared.scene(), atlas.texel_m, prepared.demand);
    atlas.coarsen = true;
    if (std::isfinite(seconds)) {
      const double ray_s = std::max(clock.spent() / kViewRays, kLeastRay_s);
      atlas.texels_in_time =
          static_cast<std::uint64_t>(std::max(1e3, kMostForFirstLight * seconds / (kFirstRays * ray_s)));
    }
  }
  ORIEL_TRY(prepared.atlas,
            timed("atlas", [&](auto&) { return build_atlas(prepared.scene(), atlas, context, prepared.demand); }));
  ORIEL_TRY(prepared.texel_map, timed("texel map", [&](auto&) { return build_texel_map(prepared.atlas, context); }));
  return {};
}

std::optional<Outshone> find_outshone(const Scene& scene, double area_m2) {
  // What Blender's exporter makes of a watt of a lamp, but not of emission; and what makes its 60 W the 65 cd of a
  // bulb.
  constexpr double kLumenPerRadiantWatt = 683, kToBulb = 65 / (60 * kLumenPerRadiantWatt / (4 * kPiD));
  const Light* lamp = nullptr;
  double all_lm = 0, most_lm = 0;
  for (const Light& light : scene.lights) {
    const double lm = luminance(punctual_power(scene, light));
    all_lm += lm;
    if (lm > most_lm) lamp = &light, most_lm = lm;
  }
  const double paint = area_m2 > 0 ? all_lm / area_m2 / kPiD : 0;
  const SceneMaterial* dead = nullptr;
  bool all_dead = true;
  for (const Surface& surface : scene.surfaces) {
    const SceneMaterial& material = scene.materials[surface.material];
    const double shine = luminance(material.emission);
    if (material.unlit || !(shine > 0)) continue;
    all_dead &= shine < paint;
    if (shine < paint && (dead == nullptr || shine > luminance(dead->emission))) dead = &material;
  }
  if (dead == nullptr) return std::nullopt;
  const double factor = paint / luminance(dead->emission);
  return Outshone{
      lamp->name,
      fmt::format("lamps of {:.3g} lm, the strongest \"{}\" of {:.3g} lm, outshine the emission of \"{}\" "
                  "{:.2g} times: white paint has {:.3g} cd/m² in their light, \"{}\" {:.3g}",
                  all_lm, lamp->name, most_lm, dead->name, factor, paint, dead->name, luminance(dead->emission)),
      "what shines of itself to be brighter than paint: bulbs and panels have thousands of cd/m²",
      fmt::format("--emission-scale {}{:.3g} if an exporter multiplied lamps by {:.0f} lm/W and emission by "
                  "nothing, or --lamp-scale {:.2g}, which makes lamps bulbs of as many watts",
                  all_dead ? "" : fmt::format("\"{}\"=", dead->name), std::max(kLumenPerRadiantWatt, 2 * factor),
                  kLumenPerRadiantWatt, std::min(kToBulb, 1 / (2 * factor)))};
}

void warn_about_light(const Scene& scene, const LightSet& lights, Context& context) {
  double area_m2 = 0;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) area_m2 += triangle_area(scene, t);
  if (const auto outshone = find_outshone(scene, area_m2))
    context.warning("light-units",
                    fmt::format("{}; expected {}: {}", outshone->found, outshone->expected, outshone->fix));
  if (lights.empty() && luminance(scene.sky) <= 0)
    context.warning("no-light",
                    "the scene has no light: no emissive material, no KHR_lights_punctual, no --sky; it is black");
}

}  // namespace oriel
