#include "bake/cli/render_arguments.h"

namespace oriel {
namespace {

constexpr const char* kFooter = R"(Examples:
  oriel-bake render house.glb --camera living -o living.exr                  256 paths a pixel
  oriel-bake render house.glb --camera walk@3.5 --error 1% -o walk.exr       as many as 1 % needs
  oriel-play house.oriel --offscreen --camera living --compare living.exr    what the player makes of it

Layers of the file, linear cd/m²: R,G,B is the sum of direct, indirect (both reflected by the diffuse lobe), specular and
emission; error, diffuse_error and specular_error are standard errors of the sum, of direct + indirect and of specular.)";

constexpr std::uint32_t kMostSamples = 1u << 24;
constexpr int kLargestSide = 16384;

Status parse_size(const std::string& text, ReferenceOptions& frame) {
  char rest = 0;
  const bool read = std::sscanf(text.c_str(), "%dx%d%c", &frame.width, &frame.height, &rest) == 2;
  if (read && std::min(frame.width, frame.height) >= 1 && std::max(frame.width, frame.height) <= kLargestSide)
    return {};
  return fail(ErrorCode::kUsage, "--size", "found '{}', expected WIDTHxHEIGHT, as 1280x720, at most {} a side", text,
              kLargestSide);
}

}  // namespace

CLI::App* add_render(CLI::App& app, RenderTexts& texts, SharedTexts& shared, Arguments& args) {
  CLI::App* render = app.add_subcommand(
      "render", "Path-traces one frame by component, with its noise: the reference that frames are compared with");
  render->footer(kFooter);
  RenderArguments& out = args.render;
  render->add_option("SCENE", out.scene, "The scene: .glb, or .gltf with its buffers and textures")->required();
  render->add_option("-o,--output", out.output, "The OpenEXR file to write")->required();
  render
      ->add_option(
          "--camera", out.camera,
          "A camera by name or by number from 0, PATH@SECONDS for a point of a path, or eye and target in world "
          "metres; as oriel-play takes it. Default: the first")
      ->type_name("NAME|N|PATH@S|ex,ey,ez,tx,ty,tz");
  render->add_option("--size", texts.size, "Pixels of the frame")->type_name("WxH")->capture_default_str();
  auto* error = render
                    ->add_option("--error", texts.error,
                                 "Instead of --samples: so many that the sum's standard error is at most this, "
                                 "relative, root mean square over the frame, dark pixels by 1 % of the mean")
                    ->check(checked(parse_fraction, "SHARE"));
  render->add_option("--samples", out.frame.samples, "Paths a pixel for each component, best a power of two")
      ->check(CLI::Range(1u, kMostSamples))
      ->excludes(error)
      ->capture_default_str();
  render->add_flag("!--no-antialias", out.frame.antialias,
                   "Every ray through its pixel's centre, as a rasteriser without supersampling sees the scene");
  render
      ->add_option("--move", texts.moves,
                   "Puts a mover there, world metres, and turns it about up by degrees from its rest; repeatable")
      ->type_name("NODE=x,y,z[,yaw]")
      ->allow_extra_args(false);
  render
      ->add_option("--mover", args.bake.import.movers, "A node that --move can move, beside those that the file marks")
      ->type_name("NODE")
      ->allow_extra_args(false);
  add_light_options(*render, shared, args);
  add_run_options(*render, shared, args);
  return render;
}

Status resolve_render(const RenderTexts& texts, Arguments& args) {
  RenderArguments& out = args.render;
  ORIEL_TRY_VOID(parse_size(texts.size, out.frame));
  if (!texts.error.empty()) {
    ORIEL_TRY(out.frame.error, parse_fraction(texts.error));
    out.frame.samples = kMostSamples;
  }
  for (const std::string& text : texts.moves) {
    ORIEL_TRY(MoverMove move, parse_move(text));
    out.moves.push_back(std::move(move));
  }
  out.import = args.bake.import;
  out.reproducible = args.bake.reproducible;
  return {};
}

}  // namespace oriel
