#include "study/diefenbach1997/without_lamps.h"

#include <algorithm>
#include <atomic>
#include <filesystem>

#include "bake/radiosity/dilate.h"
#include "bake/radiosity/estimators/cached.h"
#include "bake/radiosity/estimators/write_pages.h"
#include "bake/radiosity/stitch.h"
#include "bake/radiosity/texels/fit_texels.h"
#include "bake/radiosity/texels/seeds.h"
#include "bake/run/prepare.h"
#include "bake/trace/sampler.h"
#include "bake/transfer/bright_lights.h"
#include "formats/core/color.h"
#include "formats/core/json.h"
#include "formats/pack/reader.h"
#include "study/support/shown_scene.h"

namespace oriel::study {
namespace {

constexpr double kMoversError = 0.1;            // of the light that only movers are lit by: it is smooth
constexpr double kStitchShare = 0.6;            // of the error asked for: what stitching may move texels by
constexpr std::uint32_t kPixelsOfEye = 64;      // that the error is told from
constexpr const char* kMark = "without_lamps";  // of a pack's provenance

// A field that says nothing but where lamps are: probes inside walls, without light.
LightField field_without_light(const Scene& scene) {
  LightField field;
  field.bands = 2, field.depth_side = 2, field.depth_cap_m = 1;
  field.lower = scene.lower;
  field.cell_m = glm::max(scene.upper - scene.lower, Vec3(1e-3f));
  field.size = {1, 1, 1};
  field.cells.resize(1);
  for (std::uint32_t corner = 0; corner < 8; ++corner) {
    field.cells[0].probes[corner] = corner;
    LightProbe probe;
    probe.position = field.lower + field.cell_m * Vec3(corner & 1, corner >> 1 & 1, corner >> 2);
    probe.sh.assign(3 * 2 * 2, 0);
    probe.depth.assign(2 * 2, Vec2(1));
    field.probes.push_back(std::move(probe));
  }
  return field;
}

bool same_lamp(const BrightLight& a, const BrightLight& b) {
  return a.kind == b.kind && a.name == b.name && a.corners == b.corners && a.position == b.position &&
         a.direction == b.direction && a.intensity == b.intensity;
}

// What shines and is no bright light.
void tell_of_others(const Scene& scene, const BrightLights& all) {
  std::size_t triangles = 0;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
    if (luminance(scene.material_of(t).emission) > 0 && all.of_triangle(t) == nullptr) ++triangles;
  const auto tell = [](const std::string& what) { fmt::print(stderr, "oriel-study: in no pass: {}\n", what); };
  if (triangles > 0)
    tell(fmt::format("light of {} emissive triangles, textured or of more than 64 triangles", triangles));
  const auto profiled = std::ranges::count_if(scene.lights, [](const Light& light) { return light.profile >= 0; });
  if (profiled > 0) tell(fmt::format("light of {} lamps with profiles", profiled));
  if (luminance(scene.sky) > 0) tell("light of the sky, but for what surfaces reflect");
}

Status list_lamps(const Accel& accel, const LightSet& lights, Pack& pack) {
  BrightLights all(accel, lights);
  const std::size_t lamps = all.choose_all();
  if (lamps > kMaxBrightLights)
    return fail(ErrorCode::kUsage, "scene", "found {} lamps, expected at most {}: each is a pass", lamps,
                kMaxBrightLights);
  LightField& field = pack.light_field;
  if (field.bands == 0 && lamps > 0) field = field_without_light(accel.scene());
  for (BrightLight& lamp : all.list())
    if (std::ranges::none_of(field.lights, [&](const BrightLight& known) { return same_lamp(known, lamp); }))
      field.lights.push_back(std::move(lamp));
  tell_of_others(accel.scene(), all);
  return {};
}

void mark(Pack& pack) {
  Json provenance = Json::parse(pack.provenance).value_or(Json());
  provenance[kMark] = true;
  pack.provenance = provenance.dump();
}

bool is_marked(const Pack& pack) {
  return Json::parse(pack.provenance).value_or(Json())[kMark] == Json(true);
}

}  // namespace

Result<std::vector<LightmapPage>> bake_reflected(const LightmapScene& scene, const RadiosityOptions& options,
                                                 Context& context) {
  std::vector<Vec3> eyes = options.eyes;
  if (eyes.empty())
    eyes = sample_view_positions(scene.transport, kLightmapEyes, mix64(context.seed + seeds::kFramePixels));
  ORIEL_TRY(const std::vector<FramePixel> pixels,
            find_frame_pixels(scene.transport, scene.atlas, {eyes, kPixelsOfEye},
                              mix64(mix64(context.seed + seeds::kFramePixels)), context));
  std::atomic<std::uint64_t> rays{0}, quick_rays{0};
  const RadiosityTask task{scene, pixels, options, context, {context, &rays}, {context, &quick_rays}};
  ORIEL_TRY(const std::unique_ptr<LightEstimator> estimator, make_cached_estimator(task));
  ORIEL_TRY_VOID(estimator->refine(options.error));
  if (context.stopped()) return fail(ErrorCode::kStopped, "radiosity", "stopped");
  const std::optional<TexelLight> known = estimator->texel_light();
  const std::size_t texels = known->texels.count();
  Estimate reflected = known->reflected;
  for (std::size_t i = 0; i < known->additional.size(); ++i) reflected.value[i] -= known->additional[i];
  const Estimate none{std::vector<Vec3>(texels), std::vector<Vec3>(texels)};
  Radiosity light = empty_radiosity(scene.map, false);
  write_texels({known->texels, none, reflected, {}, {}, {}}, light);
  for (std::size_t p = 0; p < scene.map.size(); ++p) {
    if (options.fit_texels) fit_texels({scene.atlas, scene.map[p], light.reach[p]}, light.pages[p]);
    fill_buried(scene.atlas, scene.map[p], light.pages[p]);
    dilate(options.dilation, light.pages[p]);
  }
  if (!options.stitch) return std::move(light.pages);
  ORIEL_TRY(const Seams seams, find_seams(scene.transport, scene.atlas, light.pages, context));
  const double at_most = options.error > 0 ? kStitchShare * options.error : std::numeric_limits<double>::infinity();
  if (!seams.points.empty()) stitch(seams, scene.map, at_most, light.pages);
  return std::move(light.pages);
}

Result<Pack> bake_without_lamps(const std::string& scene, BakeOptions options) {
  options.scene = scene;
  options.ways = WaysWanted::kGeometry;
  options.light_groups.by = LightGrouping::kOff;
  BakeOptions rest = options;  // all but the lightmap, which is made here
  rest.radiosity.error = std::max(options.radiosity.error, kMoversError);
  rest.radiosity.detail = 1, rest.radiosity.verify = 0;
  ORIEL_TRY(Pack pack, open_or_bake(scene, rest));
  Context context;
  std::vector<StageTime> times;
  Stopwatch timed(times);
  ORIEL_TRY(PreparedScene prepared, prepare_scene(options, timed, context));
  ORIEL_TRY_VOID(lay_out_lightmap(options, timed, context, prepared));
  const LightSet lights(prepared.scene());
  const Transport transport(*prepared.accel, lights, path_options(options));
  ORIEL_TRY_VOID(list_lamps(*prepared.accel, lights, pack));
  mark(pack);
  if (lights.empty() && luminance(prepared.scene().sky) <= 0) return pack;
  RadiosityOptions radiosity = options.radiosity;
  radiosity.eyes = sample_eyes(prepared.region, kLightmapEyes, context.seed);
  ORIEL_TRY(pack.lightmaps, bake_reflected({transport, prepared.atlas, prepared.texel_map}, radiosity, context));
  return pack;
}

Result<Pack> open_without_lamps(const std::string& input, const BakeOptions& options) {
  if (std::filesystem::path(input).extension() != ".oriel") return bake_without_lamps(input, options);
  ORIEL_TRY(Pack pack, read_pack(input));
  if (!is_marked(pack))
    return fail(ErrorCode::kInvalid, input,
                "its lightmap holds the light of lamps already, which passes would add again: expected a glTF scene, "
                "or a pack that --keep of this command wrote");
  return pack;
}

}  // namespace oriel::study
