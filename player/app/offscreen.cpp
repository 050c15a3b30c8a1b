#include "player/app/offscreen.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <set>

#include "formats/camera/camera_spec.h"
#include "formats/camera/path.h"
#include "player/app/stop.h"
#include "player/gpu/headless.h"
#include "player/output/frame_record.h"
#include "player/output/picture.h"
#include "player/passes/frame.h"
#include "player/poses/poses.h"
#include "player/walk/zone.h"

namespace oriel {
namespace {
namespace fs = std::filesystem;

struct Shot {
  std::string name;
  Camera camera;
  std::string file;
  float time_s = 0;  // into the path, which the movers' clock follows
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

Status make_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) return fail(ErrorCode::kIo, path.string(), "cannot make the folder: {}", error.message());
  return {};
}

// Frames at even times over the path; files only where a folder was given.
Result<std::vector<Shot>> path_shots(const GpuScene& scene, const PlayArguments& arguments) {
  const auto& paths = scene.pack().paths;
  const auto path = std::find_if(paths.begin(), paths.end(), [&](const auto& p) { return p.name == arguments.path; });
  if (path == paths.end()) {
    return fail(ErrorCode::kUsage, "--path " + arguments.path, "found no path of that name; --list shows them");
  }
  if (!arguments.output.empty()) ORIEL_TRY_VOID(make_folder(arguments.output));
  const int count = arguments.frames > 0 ? arguments.frames : 60;
  std::vector<Shot> shots;
  for (int i = 0; i < count; ++i) {
    const float time = path_duration_s(*path) * static_cast<float>(i) / static_cast<float>(std::max(count - 1, 1));
    Shot shot{fmt::format("{}@{:.3f}", path->name, time), camera_on_path(*path, time), {}, time};
    if (!arguments.output.empty()) {
      shot.file = fs::path(arguments.output) / fmt::format("{:04}.{}", i, arguments.format);
    }
    shots.push_back(std::move(shot));
  }
  return shots;
}

Result<std::vector<Shot>> choose_shots(const GpuScene& scene, const PlayArguments& arguments) {
  const Pack& pack = scene.pack();
  const CameraChoices choices{pack.cameras, pack.paths, pack.mesh.origin};
  std::vector<Shot> shots;
  for (const std::string& text : arguments.cameras) {
    if (text == "all") {
      if (pack.cameras.empty()) return fail(ErrorCode::kUsage, "--camera all", "found no cameras in the pack");
      for (const Camera& camera : pack.cameras) shots.push_back({camera.name, camera, {}, 0});
      continue;
    }
    ORIEL_TRY(Camera camera, parse_camera(text, choices));
    shots.push_back({camera.name.empty() || text.find('@') != std::string::npos ? text : camera.name, camera, {}, 0});
  }
  if (arguments.cameras.empty()) {
    const Camera camera = initial_camera(choices, scene.bounds().lower, scene.bounds().upper);
    shots.push_back({camera.name.empty() ? "start" : camera.name, camera, {}, 0});
  }
  const fs::path output = arguments.output;
  if (output.empty()) return shots;  // nothing but times
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
  ORIEL_TRY_VOID(make_folder(output));
  std::set<std::string> taken;
  for (Shot& shot : shots) shot.file = output / (file_name(shot.name, taken) + "." + arguments.format);
  return shots;
}

class Studio {
 public:
  Studio(GpuScene& scene, Renderer& renderer, const PlayArguments& arguments)
      : scene_(scene),
        renderer_(renderer),
        arguments_(arguments),
        options_(arguments.frame),
        zone_(planned_zone(scene.pack())) {
    options_.timed = !arguments.stats.empty();
    if (arguments.ev100) options_.white = white_of_exposure(*arguments.ev100);
  }

  // Draws it `times` times; the record is the median's.
  Result<FrameRecord> draw(const Shot& shot, int times) {
    ORIEL_TRY(options_.poses, poses_at(scene_.pack(), arguments_.moves, arguments_.time_s + shot.time_s));
    const View view =
        make_view(shot.camera, arguments_.width, arguments_.height, bounds_with_movers(scene_, options_.poses));
    std::vector<FrameRecord> records;
    for (int i = 0; i < times; ++i) {
      if (stop_requested()) return fail(ErrorCode::kStopped, "", "stopped by the user");
      const auto start = std::chrono::steady_clock::now();
      ORIEL_TRY(const FrameStats stats, renderer_.render(scene_, view, options_));
      glFinish();
      const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
      records.push_back({shot.name, took.count(), stats, zone_.holds(shot.camera.eye)});
    }
    FrameRecord record = median_record(records);
    if (!arguments_.stats.empty()) ORIEL_TRY_VOID(count_holes(view, record.stats));
    return record;
  }

  // In a frame of its own: it reads images back.
  Status count_holes(const View& view, FrameStats& stats) {
    FrameOptions counting = options_;
    counting.count_holes = true;
    ORIEL_TRY(const FrameStats counted, renderer_.render(scene_, view, counting));
    stats.reflected_pixels = counted.reflected_pixels;
    stats.holes = counted.holes;
    stats.mirror_pixels = counted.mirror_pixels;
    stats.sharp = counted.sharp;
    return {};
  }

  // Into its file, if it has one; says so.
  Status keep(const Shot& shot, const FrameRecord& record) {
    float ev100 = arguments_.ev100.value_or(0.0f);
    if (!shot.file.empty()) {
      ORIEL_TRY(const std::optional<float> metered, renderer_.meter());
      if (!arguments_.ev100) ev100 = metered.value_or(0.0f);
      ORIEL_TRY_VOID(
          write_picture(renderer_, shot.file, arguments_.width, arguments_.height, ev100, arguments_.curve, shot.name));
    }
    fmt::print(stderr, "{}: {}x{} in {:.1f} ms, EV {:.2f}, {} ({})\n", shot.file.empty() ? "frame" : shot.file,
               arguments_.width, arguments_.height, record.ms, ev100, describe(record.stats, record.in_zone),
               shot.name);
    return {};
  }

 private:
  GpuScene& scene_;
  Renderer& renderer_;
  const PlayArguments& arguments_;
  FrameOptions options_;
  const Zone zone_;
};

}  // namespace

Status play_offscreen(DeferredPack pack, const PlayArguments& arguments) {
  ORIEL_TRY(const auto context, gpu::HeadlessContext::create());
  ORIEL_TRY(const gpu::Device device, gpu::open_device());
  if (arguments.gl_debug) gpu::enable_debug_output(device);
  ORIEL_TRY(const auto scene, GpuScene::create(std::move(pack), device));
  const bool along_path = !arguments.path.empty();
  ORIEL_TRY(const auto shots, along_path ? path_shots(*scene, arguments) : choose_shots(*scene, arguments));
  ORIEL_TRY(const auto renderer, Renderer::create(device));
  Studio studio(*scene, *renderer, arguments);
  std::vector<FrameRecord> records;
  FlickerMeter flicker;
  for (const Shot& shot : shots) {
    ORIEL_TRY(const FrameRecord record, studio.draw(shot, along_path ? 1 : std::max(arguments.frames, 1)));
    ORIEL_TRY_VOID(studio.keep(shot, record));
    if (along_path) flicker.add(renderer->read_light());
    records.push_back(record);
  }
  if (along_path) {
    fmt::print("{}: {} frames, median {:.1f} ms, flicker {:.4f}, worst {:.4f} at frame {}\n", arguments.path,
               records.size(), median_record(records).ms, flicker.mean(), flicker.worst(), flicker.worst_frame());
  }
  if (arguments.stats.empty()) return {};
  return write_stats(arguments.stats, arguments, device.renderer, records, along_path ? &flicker : nullptr);
}

}  // namespace oriel
