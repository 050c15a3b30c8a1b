// oriel-study diefenbach1997: lamps in passes over radiosity without its first bounce.
#include <filesystem>
#include <memory>

#include "bake/run/option_table.h"
#include "bake/run/option_values.h"
#include "formats/image/display.h"
#include "formats/image/exr.h"
#include "formats/image/relative_error.h"
#include "formats/pack/writer.h"
#include "player/movers/light_samples.h"
#include "player/navigation/poses.h"
#include "player/passes/display_pass.h"
#include "study/diefenbach1997/multi_pass.h"
#include "study/diefenbach1997/without_lamps.h"
#include "study/rooms.h"

namespace oriel::study {
namespace {

constexpr const char *kPasses = "Passes", *kBaked = "What is baked", *kMeasured = "What is measured";
constexpr Named<bool> kOnOff[] = {{"off", false}, {"on", true}};

struct PassArguments {
  ShownArguments& shown;
  MultiPassSettings passes;
  std::optional<int> orders;  // mirrors on the eye's way; none: as the player draws
  BakeOptions bake = command_line_defaults();
  std::string keep, reference;
  double step_s = 0;
};

std::vector<Option> pass_options(PassArguments& out) {
  std::vector<Option> options = shown_options(out.shown);
  append(options,
         {{"--shadow-points", kPasses, "Points of a lamp that has a size, each with its passes",
           number(out.passes.points, 1, kMaxLightPoints), Use::kEveryday},
          {"--light-mirrors", kPasses, "Mirrors on the way of light from a lamp to what it lights, at most",
           number(out.passes.mirrors, 0, kMostLightMirrors), Use::kEveryday},
          {"--shadow-mirrors", kPasses, "Light by way of more mirrors than this throws no shadows; -1: no light does",
           number(out.passes.shadow_mirrors, -1, kMostLightMirrors), Use::kEveryday},
          {"--bent-shadows", kPasses,
           "Whether what light meets before a mirror throws shadows by way of it; off: what stands behind the last "
           "mirror alone does",
           choice(out.passes.bent_shadows, kOnOff), Use::kEveryday},
          {"--orders", kPasses, "Mirrors on the way of the eye, 0: none is drawn; without it as oriel-play",
           number(out.orders, 0, 16), Use::kEveryday},
          {"--texel", kBaked, "Of a scene: side of the lightmap's texels; without it as oriel-bake",

           or_auto(out.bake.choose_texel, "LENGTH", quantity(out.bake.atlas.texel_m, "", parse_length, length_text)),
           Use::kEveryday},
          {"--keep", kBaked, "Writes what was baked, to be given in place of the scene", text(out.keep, "PACK"),
           Use::kEveryday},
          {"--step", kMeasured, "Seconds that movers go on from frame to frame, each of which is drawn and told of",
           number(out.step_s, 0, 1e6), Use::kEveryday},
          {"--reference", kMeasured,
           "A file of oriel-bake render; prints how far the frame, shrunk to its size, is from it",
           text(out.reference, "EXR"), Use::kEveryday}});
  return options;
}

void print(const MultiPassStats& s) {
  const VolumeStats& v = s.volumes;
  fmt::print(
      "  {} images, {} light, {} shadow and {} aperture passes, {} ways of light, {} left out\n"
      "  volumes: {} new, {} for light, {} for objects, {} reused, built in {:.1f} ms, {} kB kept\n",
      s.images, s.light_passes, s.shadow_passes, s.aperture_passes, s.paths, s.left_out, v.built_new, v.built_for_light,
      v.built_for_object, v.reused, v.build_ms, v.bytes / 1000);
}

// RMS of the last frame's difference as shown, net of the reference's noise, over what is shown as white.
Status print_error(const Renderer& renderer, const PassArguments& arguments) {
  ORIEL_TRY(const LayeredImage file, read_layered_exr(arguments.reference));
  const auto light = file.layers.find(""), noise = file.layers.find("error");
  if (light == file.layers.end() || noise == file.layers.end())
    return fail(ErrorCode::kInvalid, arguments.reference,
                "has no light or no error, expected a file of oriel-bake render");
  const UVec2 size(renderer.frame_size());
  const std::uint32_t n = std::max(1u, size.x / light->second.width);
  const FloatImage frame = shrink({size.x, size.y, 3, renderer.read_light()}, n);
  if (frame.width != light->second.width || frame.height != light->second.height)
    return fail(ErrorCode::kUsage, "--width", "found {} x {}, expected a multiple of the reference's {} x {}", size.x,
                size.y, light->second.width, light->second.height);
  const auto& ev100 = arguments.shown.ev100;
  const float white = ev100 ? white_of_exposure(*ev100) : white_of(light->second);
  const double all = mean_over(squared_difference(shown(frame, white), shown(light->second, white)));
  const double net = all - mean_over(shown_variance(light->second, noise->second, white));
  fmt::print("  RMS error {:.2f} %\n", 100 * std::sqrt(std::max(net, 0.0)));
  return {};
}

// The cameras one by one: each has its passes counted.
std::vector<ShownArguments> each_camera(const ShownArguments& all, const Pack& pack) {
  std::vector<std::string> cameras;
  for (const std::string& camera : all.cameras) {
    if (camera != "all") cameras.push_back(camera);
    for (std::size_t i = 0; camera == "all" && i < pack.cameras.size(); ++i) cameras.push_back(std::to_string(i));
  }
  std::vector<ShownArguments> out(std::max<std::size_t>(cameras.size(), 1), all);
  std::error_code failed;  // the picture tells of it
  if (cameras.size() > 1 && !all.output.empty()) std::filesystem::create_directories(all.output, failed);
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    out[i].cameras = {cameras[i]};
    if (cameras.size() > 1 && !all.output.empty()) out[i].output = fmt::format("{}/{:02}.png", all.output, i);
  }
  return out;
}

FrameOptions frame_options(const PassArguments& arguments) {
  FrameOptions options;
  options.samples = 4;
  options.reflections = arguments.orders == 0 ? Reflections::kOff : Reflections::kGeometry;
  if (arguments.orders > 0) options.orders = arguments.orders;
  options.mover_lights = MoverLights::kHarmonics;  // the lightmap has no light for movers' shadows to take
  return options;
}

Status draw_passes(PassArguments& arguments) {
  ORIEL_TRY_VOID(settle(arguments.bake, {}));
  ORIEL_TRY(Pack pack, open_without_lamps(arguments.shown.input, arguments.bake));
  if (!arguments.keep.empty()) ORIEL_TRY_VOID(write_pack(arguments.keep, pack));
  ORIEL_TRY(ShownScene scene, ShownScene::open(std::move(pack)));
  FrameOptions options = frame_options(arguments);
  MultiPass passes(scene.device.dialect, arguments.passes);
  for (ShownArguments& one : each_camera(arguments.shown, scene.scene->pack())) {
    const int steps = arguments.step_s > 0 ? std::exchange(one.frames, 1) : 1;
    for (int i = 0; i < steps; ++i) {
      ORIEL_TRY(options.poses, poses_at(scene.scene->pack(), {}, i * arguments.step_s));
      ORIEL_TRY_VOID(draw_cameras(scene, one, options, &passes));
      print(passes.stats());
    }
    if (!arguments.reference.empty()) ORIEL_TRY_VOID(print_error(*scene.renderer, arguments));
  }
  return {};
}

}  // namespace

ToolCommand diefenbach1997_command(ShownArguments& arguments) {
  const auto own = std::make_shared<PassArguments>(arguments);
  return {.name = "diefenbach1997",
          .help =
              "Lamps in passes of their own, each with its shadow volumes, in mirrors and by way of mirrors, over a "
              "lightmap without their light (Diefenbach & Badler 1997)",
          .footer = "docs/study/diefenbach1997.md tells what the paper says and what is measured.",
          .options = pass_options(*own),
          .run = [own] { return draw_passes(*own); }};
}

}  // namespace oriel::study
