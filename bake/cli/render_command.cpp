#include "bake/cli/commands.h"
#include "bake/jobs/parallel.h"
#include "bake/reference/reference.h"
#include "bake/run/option_table.h"
#include "bake/run/option_values.h"
#include "bake/run/pipeline.h"
#include "bake/run/prepare.h"
#include "bake/run/view_options.h"
#include "formats/image/exr.h"
#include "formats/query/camera_notes.h"

namespace oriel {
namespace {

constexpr const char* kRenderFooter = R"(Examples:
  oriel-bake render house.glb --camera living -o living.exr                  256 paths a pixel
  oriel-bake render house.glb --camera walk@3.5 --error 1% -o walk.exr       as many as 1 % needs
  oriel-play house.oriel --offscreen --camera living --compare living.exr    what the player makes of it

Layers of the file, linear cd/m²: R,G,B is the sum of direct, indirect (both reflected by the diffuse lobe), specular and
emission; error, diffuse_error and specular_error are standard errors of the sum, of direct + indirect and of specular.)";

constexpr std::uint32_t kMostSamples = 1u << 24;
constexpr const char* kFrame = kFrameGroup;

struct RenderArguments {
  std::filesystem::path scene, output;
  std::string camera;  // as written; empty: the scene's first
  ImportOptions import;
  bool guess_unit = true;  // as a bake does: eyes are in the pack's metres
  ReferenceOptions frame{.width = 1280, .height = 720, .samples = 256};
  bool reproducible = false;  // the same pixels on every CPU type
};

Result<ImportedScene> import_in_metres(const RenderArguments& args, Context& context) {
  ORIEL_TRY(ImportedScene imported, import_gltf(args.scene, args.import, context));
  if (!args.guess_unit) return imported;
  ORIEL_TRY(const Accel accel, Accel::build(imported.scene, {args.reproducible, thread_count(context)}));
  const auto unit_m = guessed_unit(accel, args.import.unit_m, context);
  if (!unit_m) return imported;
  ImportOptions again = args.import;
  again.unit_m = *unit_m;
  const auto warn = std::exchange(context.warn, nullptr);  // all was said before
  auto scaled = import_gltf(args.scene, again, context);
  context.warn = warn;
  return scaled;
}

Status run_render(const RenderArguments& args, BakeSession& session) {
  Context& context = session.context;
  stop_on_signals(context, args.output, OnStop::kStop);
  session.less_memory = "a smaller --size";
  ORIEL_TRY_VOID(check_output(args.output, inputs_of(args.scene, args.import)));
  ORIEL_TRY(const ImportedScene imported, import_in_metres(args, context));
  const Scene& scene = imported.scene;
  ORIEL_TRY(const Camera camera, choose_camera(scene, args.camera));
  ORIEL_TRY(const Accel accel, Accel::build(scene, {args.reproducible, thread_count(context)}));
  const LightSet lights(scene, &accel);
  warn_about_light(scene, lights, context);
  ORIEL_TRY(ReferenceFrame frame, render_reference({accel, lights, {}}, camera, args.frame, context));
  LayeredImage image;
  image.layers = {{"", std::move(frame.total)},
                  {"direct", std::move(frame.direct)},
                  {"indirect", std::move(frame.indirect)},
                  {"specular", std::move(frame.specular)},
                  {"emission", std::move(frame.emission)},
                  {"error", std::move(frame.noise)},
                  {"diffuse_error", std::move(frame.diffuse_noise)},
                  {"specular_error", std::move(frame.specular_noise)}};
  image.attributes = camera_notes(camera, scene.origin);
  image.attributes["oriel.camera"] = args.camera.empty() ? camera.name : args.camera;
  image.attributes["oriel.unit"] = "cd/m2";
  image.attributes["oriel.samples"] = std::to_string(frame.samples);
  image.attributes["oriel.noise"] = fmt::format("{:.4g}", frame.relative_noise);
  return write_exr(args.output, image);
}

std::vector<Option> frame_options(RenderArguments& args) {
  return {
      scene_argument(args.scene),
      {"-o,--output", kFrame, "The OpenEXR file to write", path(args.output, "FILE"), Use::kRequired},
      camera_option(args.camera),
      size_option(args.frame.width, args.frame.height),
      {"--error", kFrame,
       "Instead of --samples: so many that the sum's standard error is at most this, relative, root mean square over "
       "the frame, dark pixels by 1 % of the mean",
       quantity(args.frame.error, "SHARE", parse_share, share_text), Use::kEveryday},
      {"--samples", kFrame, "Paths a pixel for each component, best a power of two",
       number(args.frame.samples, 1, kMostSamples), Use::kEveryday, "", "", "--error"},
      {"--no-antialias", kFrame,
       "Every ray through its pixel's centre, as a rasteriser without supersampling sees the scene",
       flag(args.frame.antialias, false)},
  };
}

}  // namespace

ToolCommand render_command(BakeSession& session) {
  const auto args = std::make_shared<RenderArguments>();
  args->import.clear_sky = true;
  ToolCommand out{
      .name = "render",
      .help = "Path-traces one frame by component, with its noise: the reference that frames are compared with",
      .footer = kRenderFooter,
      .options = frame_options(*args)};
  append(out.options, mover_options(args->import));
  append(out.options, light_options(args->import));
  out.options.push_back(unit_option(args->import, args->guess_unit));
  append(out.options, scene_options(args->import, args->reproducible));
  append(out.options, run_options(session));
  out.settle = [args](const Given& given) -> Status {
    if (given.has("--error")) args->frame.samples = kMostSamples;
    if (args->output.extension() != ".exr")
      return fail(ErrorCode::kUsage, "-o " + args->output.string(),
                  "found '{}', expected .exr: light in cd/m2, by component", args->output.extension().string());
    return {};
  };
  out.run = [args, &session] { return run_render(*args, session); };
  return out;
}

}  // namespace oriel
