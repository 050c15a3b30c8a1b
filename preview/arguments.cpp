#include "preview/arguments.h"

#include "bake/run/option_table.h"
#include "bake/run/version.h"
#include "bake/run/view_options.h"
#include "player/session/option_names.h"

namespace oriel {
namespace {

constexpr const char* kFooter = R"(Examples:
  oriel-preview house.glb                                      walk through it at once; the file is followed as it is saved
  oriel-preview house.glb --offscreen --camera hall -o a.png   16 passes into a file
  oriel-preview house.glb --offscreen --paths 256 -o a.exr     whole paths on top: towards oriel-bake render's

Keys of the window are those of oriel-play: WASD and mouse walk, Tab opens the panel.)";

constexpr std::uint32_t kMostPasses = 1u << 20;

std::vector<Option> output_options(PreviewArguments& a) {
  return {
      {"SCENE", "Arguments", "The scene: .glb, .gltf, or of another program: .fbx .dae .ifc .obj .3ds .ply .stl",
       path(a.scene.file, "FILE"), Use::kRequired},
      {"--offscreen", kFrameGroup, "Draws one frame into a file, without a window", flag(a.offscreen), Use::kEveryday},
      {"-o,--output", kFrameGroup, "The picture: .png as shown, .exr linear cd/m²", path(a.output, "FILE"),
       Use::kEveryday, "", "", "", "--offscreen"},
      camera_option(a.camera),
      size_option(a.width, a.height),
      {"--passes", kFrameGroup, "Passes over the frame that are added up while nothing moves",
       number(a.passes, 1, kMostPasses), Use::kEveryday},
      {"--paths", kFrameGroup,
       "Whole paths a pixel after the passes, by the estimator of oriel-bake render. A window goes on with them as "
       "long as nothing moves. Default: 4096 there, 0 of --offscreen",
       number(a.paths, 0, kMostPasses), Use::kEveryday},
      {"--ev", kFrameGroup, "Exposure value at ISO 100. Default: by the frame", number(a.ev100, -100, 100)},
      {"--tonemap", kFrameGroup, "Tone curve of what is shown", choice(a.curve, kToneCurves)},
      {"--frames", kFrameGroup, "The window closes after so many frames", number(a.frames, 1, 1e9)},
      {"--pack", kFrameGroup, "The pack that \"bake this view\" writes. Default: beside the scene, .oriel",
       path(a.pack, "FILE")},
      {"--stats", kFrameGroup, "A line of JSON on stdout: seconds to the first lit frame, and of each stage of a pass",
       flag(a.stats)},
  };
}

std::vector<Option> effect_options(PreviewArguments& a) {
  constexpr const char* kEffects = "Effects";
  return {
      {"--samples", kEffects,
       "Points on lamps in each pass, shared by what they give what the eye sees; at least one for each kind of "
       "lamp",
       number(a.frame.samples, 1, 4096), Use::kEveryday},
      {"--elements", kEffects,
       "At most so many elements of surfaces shine back what comes to them, after any number of bounces; each pass "
       "finds others, finer where the eye gets more of them, and takes 36; 0: none",
       number(a.frame.elements, 0, 65536)},
      {"--glossy", kEffects, "Roughness below which reflections are traced", number(a.frame.glossy, 0, 1)},
  };
}

// Why an option that was given changes nothing; null where it does.
const char* idle_reason(const std::string& option, const PreviewArguments& a) {
  if (a.offscreen && (option == "--frames" || option == "--pack")) return "--offscreen has no window";
  if (a.output.extension() == ".exr" && (option == "--ev" || option == "--tonemap"))
    return ".exr files hold light, not what is shown";
  if (a.scene.import.sky_file.empty() && (option == "--sky-scale" || option == "--sky-rotation"))
    return "--sky names no file";
  return nullptr;
}

}  // namespace

CommandLine preview_command_line(PreviewArguments& a, std::function<Status()> run) {
  ToolCommand command{.name = "oriel-preview",
                      .help = "Shows a scene as it will be lit, at once and better while one looks, before any bake",
                      .footer = kFooter,
                      .options = output_options(a)};
  append(command.options, effect_options(a));
  std::vector<Option> baked = mover_options(a.scene.import);  // that oriel-bake takes too
  a.scene.import.clear_sky = true;
  append(baked, light_options(a.scene.import));
  append(baked, scene_options(a.scene.import, a.reproducible));
  append(baked, {{"--threads", "Run", "Threads of rays; 0: all CPUs", number(a.threads, 0, 1024), Use::kEveryday},
                 {"--seed", "Run", "Of every random number", number(a.seed, 0, 18446744073709551615.0)}});
  append(command.options, baked);
  command.settle = [&a, baked](const Given& given) -> Status {
    a.bake_options = given.words(baked);
    for (const std::string& option : given.typed())
      if (const char* reason = idle_reason(option, a))
        fmt::print(stderr, "oriel-preview: {} has no effect: {}\n", option, reason);
    if (a.pack.empty()) a.pack = std::filesystem::path(a.scene.file).replace_extension(".oriel");
    if (!a.offscreen) return {};
    const auto ending = a.output.extension();
    if (!a.output.empty() && ending != ".png" && ending != ".exr")
      return fail(ErrorCode::kUsage, "-o " + a.output.string(), "found '{}', expected .png or .exr", ending.string());
    if (a.output.empty() && !a.stats)
      return fail(ErrorCode::kUsage, "--offscreen", "found no output, expected -o FILE.png, -o FILE.exr or --stats");
    return {};
  };
  command.run = std::move(run);
  return {kVersion, std::move(command)};
}

}  // namespace oriel
