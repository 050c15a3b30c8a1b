#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>

#include "formats/query/camera_spec.h"
#include "player/navigation/view.h"
#include "player/output/picture.h"
#include "study/herf1997/herf1997.h"
#include "study/herf1997/texture_shadows.h"
#include "study/rooms.h"

namespace oriel::study {
namespace {

constexpr float kCircle = 0.1f;       // metres, that each mover goes about where it rests
constexpr int kManySamples = 1024;    // of a lamp: what frames are held against
constexpr double kLeastShade = 1e-3;  // of the light: less is no shadow

std::vector<MoverPose> poses_at(const Pack& pack, int frame) {
  std::vector<MoverPose> poses;
  for (std::size_t i = 0; i < pack.movers.size(); ++i) {
    const float angle = 0.3f * static_cast<float>(frame) + static_cast<float>(i);
    const float half = 0.1f * static_cast<float>(frame);
    MoverPose pose = pack.movers[i].rest;
    pose.position += kCircle * Vec3(std::cos(angle), 0, std::sin(angle));
    pose.rotation = {0, std::sin(half), 0, std::cos(half)};
    poses.push_back(pose);
  }
  return poses;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// The movers of a pack at the places of a frame, before a camera.
struct MovingScene {
  ShownScene& shown;
  Camera camera;
  int width, height;

  Status draw(int frame, MoverLights lights, TextureShadows* shadows) const {
    FrameOptions options;
    options.mover_lights = lights;
    options.poses = poses_at(shown.scene->pack(), frame);
    const View view = make_view(camera, width, height, bounds_with_movers(*shown.scene, options.poses));
    ORIEL_TRY_VOID(shown.renderer->render(*shown.scene, view, options, shadows));
    glFinish();
    return {};
  }
};

struct Drawn {
  double ms = 0, paint_ms = 0;  // medians
  std::size_t textures = 0;     // of the last frame
  std::vector<float> light;     // RGB
};

// The median of frames in which all movers move, and the last of them.
Result<Drawn> draw_frames(const MovingScene& scene, int frames, TextureShadows* shadows) {
  std::vector<double> ms, paint;
  for (int frame = 0; frame <= frames; ++frame) {  // the first makes what later ones keep
    const auto start = std::chrono::steady_clock::now();
    ORIEL_TRY_VOID(scene.draw(frame, MoverLights::kShadowed, shadows));
    if (frame == 0) continue;
    ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    if (shadows != nullptr) paint.push_back(shadows->paint_ms);
  }
  Drawn drawn{median(ms), 0, 0, scene.shown.renderer->read_light()};
  if (shadows != nullptr) drawn.paint_ms = median(paint), drawn.textures = shadows->textures();
  return drawn;
}

// Of green light where movers shade the scene: root mean square, and what 95 % of the pixels are within.
struct Difference {
  double rms = 0, within = 0;
  std::size_t pixels = 0;
};
struct Shade {
  std::vector<float> open, exact;  // without shadows; by many samples
  std::vector<std::int32_t> what;  // Renderer::read_reflective()

  Difference between(const std::vector<float>& a, const std::vector<float>& b) const {
    std::vector<double> errors;
    double squares = 0;
    for (std::size_t i = 1; i < open.size(); i += 3) {
      const double light = open[i];
      if (what[i / 3] != -1 || !(light > 0) || light - double{exact[i]} < kLeastShade * light) continue;
      errors.push_back(std::abs(double{a[i]} - double{b[i]}) / light);
      squares += errors.back() * errors.back();
    }
    if (errors.empty()) return {};
    std::ranges::sort(errors);
    return {std::sqrt(squares / static_cast<double>(errors.size())), errors[errors.size() * 95 / 100], errors.size()};
  }
};

Result<Camera> camera_of(const GpuScene& scene, const std::vector<std::string>& asked) {
  ORIEL_TRY(const std::vector<Camera> cameras, shown_cameras(scene, asked));
  if (cameras.size() > 1) return fail(ErrorCode::kUsage, "--camera", "found {}, expected one", cameras.size());
  return cameras[0];
}

// Writes the frame that was drawn last into the folder that was asked for, if any.
Status write_frame(const MovingScene& scene, const ShownArguments& arguments, const char* name, float ev100) {
  if (arguments.output.empty()) return {};
  const std::filesystem::path folder = arguments.output;
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) return fail(ErrorCode::kIo, arguments.output, "cannot be made: {}", failed.message());
  return write_picture(*scene.shown.renderer, (folder / name).string(),
                       {scene.camera, scene.shown.scene->pack().mesh.origin, scene.camera.name, ev100});
}

void print_row(const char* name, const Drawn& drawn, const Difference& error) {
  fmt::print("| {} | {:.1f} | {:.1f} | {:.2f} % | {:.2f} % |\n", name, drawn.ms, drawn.paint_ms, 100 * error.rms,
             100 * error.within);
}

}  // namespace

Status run_herf1997(const ShownArguments& arguments, const Herf1997Settings& settings) {
  if (settings.bench) return print_herf1997_bench(), Status();
  if (arguments.input.empty()) return fail(ErrorCode::kUsage, "INPUT", "found none, expected a scene or pack");
  BakeOptions options;
  ORIEL_TRY(Pack pack, open_or_bake(arguments.input, options));
  if (pack.movers.empty())
    return fail(ErrorCode::kUsage, arguments.input,
                "found no movers, expected some: oriel-bake --object NODE:mover makes them");
  ORIEL_TRY(ShownScene shown, ShownScene::open(std::move(pack)));
  ORIEL_TRY(const Camera camera, camera_of(*shown.scene, arguments.cameras));
  ORIEL_TRY(TextureShadows textures, TextureShadows::create(shown.device.dialect));
  const MovingScene scene{shown, camera, arguments.width, arguments.height};
  const int frames = arguments.frames;

  Shade shade;
  ORIEL_TRY_VOID(scene.draw(frames, MoverLights::kUnshadowed, nullptr));
  shade.open = shown.renderer->read_light();
  ORIEL_TRY(const Drawn maps, draw_frames(scene, frames, nullptr));
  ORIEL_TRY(const std::optional<float> metered, shown.renderer->meter());
  const float ev100 = arguments.ev100.value_or(metered.value_or(0.0f));
  ORIEL_TRY_VOID(write_frame(scene, arguments, "maps.png", ev100));
  textures.samples = settings.samples;
  ORIEL_TRY(const Drawn by_textures, draw_frames(scene, frames, &textures));
  ORIEL_TRY_VOID(write_frame(scene, arguments, "textures.png", ev100));
  textures.samples = kManySamples;
  ORIEL_TRY_VOID(scene.draw(frames, MoverLights::kShadowed, &textures));
  shade.exact = shown.renderer->read_light();
  shade.what = shown.renderer->read_reflective();

  const Difference between = shade.between(by_textures.light, maps.light);
  fmt::print("{} textures of {} samples, {} pixels in shadow; errors beside textures of {} samples, of the light\n",
             by_textures.textures, settings.samples, between.pixels, kManySamples);
  fmt::print(
      "without shadows\n\n| shadows | ms a frame | ms of it painting | RMS error | 95 % within |\n"
      "|---|---|---|---|---|\n");
  print_row("maps", maps, shade.between(maps.light, shade.exact));
  print_row("textures", by_textures, shade.between(by_textures.light, shade.exact));
  fmt::print("\ntextures and maps differ by {:.2f} %, 95 % within {:.2f} %\n", 100 * between.rms, 100 * between.within);
  return {};
}

ToolCommand herf1997_command(ShownArguments& arguments, Herf1997Settings& settings) {
  std::vector<Option> options = shown_options(arguments);
  options[0].use = Use::kEveryday;  // the bench needs none
  append(options,
         {{"--samples", "Method", "Points of each lamp", number(settings.samples, 1, kManySamples), Use::kEveryday},
          {"--bench", "Method", "Prints textures a second and errors of small scenes instead", flag(settings.bench),
           Use::kEveryday}});
  return {.name = "herf1997",
          .help = "Movers' shadows on flat surfaces as soft-shadow textures (Herf 1997), beside shadow maps.",
          .footer = "Writes maps.png and textures.png into the folder of --output.",
          .options = std::move(options),
          .run = [&] { return run_herf1997(arguments, settings); }};
}

}  // namespace oriel::study
