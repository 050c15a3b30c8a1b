#include "player/app/offscreen.h"

#include <chrono>
#include <filesystem>
#include <set>

#include "formats/image/exr.h"
#include "formats/image/png.h"
#include "player/app/stop.h"
#include "player/gpu/headless.h"
#include "player/passes/frame.h"
#include "formats/camera/camera_spec.h"

namespace oriel {
namespace {
namespace fs = std::filesystem;

struct Shot {
  std::string name;
  Camera camera;
  std::string file;
};

bool is_picture(const fs::path& path) {
  return path.extension() == ".png" || path.extension() == ".exr";
}

// A camera's name as a file name: what is not a plain character becomes '_'; repeated names are numbered.
std::string file_name(const std::string& camera, std::set<std::string>& taken) {
  std::string name;
  for (const char c : camera) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
                       c == '_' || (c == '.' && !name.empty());
    name += plain ? c : '_';
  }
  if (name.empty()) name = "camera";
  std::string unique = name;
  for (int i = 2; !taken.insert(unique).second; ++i) unique = fmt::format("{}-{}", name, i);
  return unique;
}

Result<std::vector<Shot>> choose_shots(const GpuScene& scene, const PlayArguments& arguments) {
  const Pack& pack = scene.pack();
  const CameraChoices choices{pack.cameras, pack.paths, pack.mesh.origin};
  std::vector<Shot> shots;
  for (const std::string& text : arguments.cameras) {
    if (text == "all") {
      if (pack.cameras.empty()) return fail(ErrorCode::kUsage, "--camera all", "found no cameras in the pack");
      for (const Camera& camera : pack.cameras) shots.push_back({camera.name, camera, {}});
      continue;
    }
    ORIEL_TRY(Camera camera, parse_camera(text, choices));
    shots.push_back({camera.name.empty() || text.find('@') != std::string::npos ? text : camera.name, camera, {}});
  }
  if (arguments.cameras.empty()) {
    const Camera camera = initial_camera(choices, scene.bounds().lower, scene.bounds().upper);
    shots.push_back({camera.name.empty() ? "start" : camera.name, camera, {}});
  }
  const fs::path output = arguments.output;
  if (shots.size() == 1 && is_picture(output)) {
    shots[0].file = output;
    return shots;
  }
  if (shots.size() == 1 && output.has_extension() && !fs::is_directory(output)) {
    return fail(ErrorCode::kUsage, "-o " + arguments.output, "found '{}', expected .png, .exr or a folder",
                output.extension().string());
  }
  if (shots.size() > 1 && is_picture(output)) {
    return fail(ErrorCode::kUsage, "-o " + arguments.output, "found one file for {} cameras, expected a folder",
                shots.size());
  }
  std::error_code error;
  fs::create_directories(output, error);
  if (error) return fail(ErrorCode::kIo, arguments.output, "cannot make the folder: {}", error.message());
  std::set<std::string> taken;
  for (Shot& shot : shots) shot.file = output / (file_name(shot.name, taken) + "." + arguments.format);
  return shots;
}

}  // namespace

std::string describe(const FrameStats& stats) {
  return fmt::format("{} draws, {} triangles, {} reflectors, {} maps, {} points", stats.draws, stats.triangles,
                     stats.reflectors, stats.maps, stats.points);
}

Status write_picture(Renderer& renderer, const std::string& path, int width, int height, float ev100, ToneCurve curve,
                     const std::string& camera) {
  const auto w = static_cast<std::uint32_t>(width), h = static_cast<std::uint32_t>(height);
  if (fs::path(path).extension() == ".exr") {
    return write_exr(
        path, FloatImage{w, h, 3, renderer.read_light()},
        {{"oriel.camera", camera}, {"oriel.unit", "cd/m2"}, {"oriel.ev100", fmt::format("{:.3f}", ev100)}});
  }
  ORIEL_TRY(std::vector<std::uint8_t> pixels, renderer.read_display(ev100, curve));
  return write_png(path, ByteImage{w, h, 3, std::move(pixels)});
}

Status play_offscreen(Pack pack, const PlayArguments& arguments) {
  ORIEL_TRY(const auto context, gpu::HeadlessContext::create());
  ORIEL_TRY(const gpu::Device device, gpu::open_device());
  if (arguments.gl_debug) gpu::enable_debug_output(device);
  ORIEL_TRY(const auto scene, GpuScene::create(std::move(pack), device));
  ORIEL_TRY(const auto shots, choose_shots(*scene, arguments));
  ORIEL_TRY(const auto renderer, Renderer::create(device));
  FrameOptions options = arguments.frame;
  if (arguments.ev100) options.white = white_of_exposure(*arguments.ev100);
  for (const Shot& shot : shots) {
    if (stop_requested()) return fail(ErrorCode::kStopped, "", "stopped by the user");
    const auto start = std::chrono::steady_clock::now();
    const View view = make_view(shot.camera, arguments.width, arguments.height, scene->bounds());
    ORIEL_TRY(const FrameStats stats, renderer->render(*scene, view, options));
    glFinish();
    const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    ORIEL_TRY(const std::optional<float> metered, renderer->meter());
    const float ev100 = arguments.ev100.value_or(metered.value_or(0.0f));
    ORIEL_TRY_VOID(
        write_picture(*renderer, shot.file, arguments.width, arguments.height, ev100, arguments.curve, shot.name));
    fmt::print(stderr, "{}: {}x{} in {:.1f} ms, EV {:.2f}, {} ({})\n", shot.file, arguments.width, arguments.height, ms,
               ev100, describe(stats), shot.name);
  }
  return {};
}

}  // namespace oriel
