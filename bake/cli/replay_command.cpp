#include "bake/cli/commands.h"
#include "bake/run/option_table.h"
#include "bake/run/pipeline.h"
#include "bake/run/replay.h"
#include "bake/run/view_options.h"
#include "formats/core/file.h"

namespace oriel {
namespace {

constexpr const char* kReplayFooter = R"(Examples:
  oriel-bake replay house.glb --texel 5cm --at texel:0,120,44               its first path
  oriel-bake replay house.glb --camera living --at pixel:640,360 --count 16

Options are those of the bake or of the frame that is looked into: the same options give the same random numbers.
A texel's paths are those of --estimator reference, a pixel's those of oriel-bake render.)";

struct ReplayArguments {
  BakeOptions bake = command_line_defaults();
  std::string camera;
  ReferenceOptions frame{.width = 1280, .height = 720};
  bool pixel = false;
  TexelAddress texel;  // a pixel's x and y, too
  PathRange paths;
};

OptionValue place(ReplayArguments& args) {
  return {"texel:P,X,Y|pixel:X,Y",
          [&args](const std::string& typed) -> Status {
            TexelAddress& at = args.texel;
            char rest = 0;
            args.pixel = std::sscanf(typed.c_str(), "pixel:%u,%u%c", &at.x, &at.y, &rest) == 2;
            if (args.pixel || std::sscanf(typed.c_str(), "texel:%u,%u,%u%c", &at.page, &at.x, &at.y, &rest) == 3)
              return {};
            return fail(ErrorCode::kUsage, "", "found '{}', expected texel:PAGE,X,Y or pixel:X,Y, from 0", typed);
          },
          [&args] {
            const TexelAddress& at = args.texel;
            return args.pixel ? fmt::format("pixel:{},{}", at.x, at.y)
                              : fmt::format("texel:{},{},{}", at.page, at.x, at.y);
          }};
}

Result<std::string> replay_of_frame(const ReplayArguments& args, Context& context) {
  ORIEL_TRY(const ImportedScene imported, import_gltf(args.bake.scene, args.bake.import, context));
  ORIEL_TRY(const Camera camera, choose_camera(imported.scene, args.camera));
  ORIEL_TRY(const Accel accel, Accel::build(imported.scene, {args.bake.reproducible, context.threads}));
  const LightSet lights(imported.scene);
  const PixelSample first{context.seed, args.texel.x, args.texel.y, args.paths.first};
  return replay_pixel({accel, lights, {}}, camera, args.frame, first, args.paths.count);
}

Status run_replay(const ReplayArguments& args, BakeSession& session) {
  ORIEL_TRY(const std::string text, args.pixel ? replay_of_frame(args, session.context)
                                               : replay_texel(args.bake, args.texel, args.paths, session.context));
  return print(text);
}

}  // namespace

ToolCommand replay_command(BakeSession& session) {
  const auto args = std::make_shared<ReplayArguments>();
  constexpr std::uint32_t kMost = 1u << 24;
  ToolCommand out{
      .name = "replay",
      .help = "Runs the paths of one texel or pixel alone, with its random numbers, and prints them",
      .footer = kReplayFooter,
      .options = {scene_argument(args->bake.scene),
                  {"--at", "Replay", "The texel of a page, or the pixel of a frame", place(*args), Use::kRequired},
                  {"--first", "Replay", "The first path's number", number(args->paths.first, 0, kMost), Use::kEveryday},
                  {"--count", "Replay", "How many paths", number(args->paths.count, 1, kMost), Use::kEveryday},
                  camera_option(args->camera),
                  size_option(args->frame.width, args->frame.height)}};
  append(out.options, bake_options(args->bake));
  append(out.options, run_options(session));
  out.settle = [args](const Given& given) { return settle(args->bake, given); };
  out.run = [args, &session] { return run_replay(*args, session); };
  return out;
}

}  // namespace oriel
