#include "player/app/shots.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <set>

#include "formats/query/camera_spec.h"
#include "formats/query/path.h"
#include "player/navigation/path_file.h"
#include "player/navigation/smooth.h"

namespace oriel {
namespace {
namespace fs = std::filesystem;

constexpr int kFramesOfPath = 60;  // unless told
constexpr double kMostFrames = 1e6;

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

struct FrameTimes {
  int count = 0;
  double step_s = 0;
};

// By --fps a fixed step from the start on, else so many frames from end to end.
Result<FrameTimes> frame_times(const CameraPath& path, const PlayArguments& arguments) {
  const double duration = path_duration_s(path);
  if (arguments.fps > 0) {
    // A path of 2 s has 61 frames at 30 a second, whatever its keys' rounding.
    const double count = std::floor(duration * arguments.fps + 1e-4) + 1;
    if (count > kMostFrames)
      return fail(ErrorCode::kUsage, "--path " + arguments.path, "found {:.0f} frames, expected {:.0f} at most", count,
                  kMostFrames);
    return FrameTimes{static_cast<int>(count), 1 / arguments.fps};
  }
  const int count = arguments.frames > 0 ? arguments.frames : kFramesOfPath;
  return FrameTimes{count, duration / std::max(count - 1, 1)};
}

}  // namespace

Result<std::vector<Shot>> path_shots(const GpuScene& scene, const PlayArguments& arguments) {
  ORIEL_TRY(CameraPath path, choose_path(arguments.path, scene.pack().paths, scene.pack().mesh.origin));
  ORIEL_TRY(const FrameTimes times, frame_times(path, arguments));
  if (!arguments.output.empty()) ORIEL_TRY_VOID(make_folder(arguments.output));
  const std::string name = path.name;
  const auto camera_at = [path = std::make_shared<CameraPath>(std::move(path)), smooth_s = arguments.smooth_s](
                             float time_s) { return smoothed_camera_on_path(*path, time_s, smooth_s); };
  std::vector<Shot> shots;
  for (int i = 0; i < times.count; ++i) {
    const auto time = static_cast<float>(times.step_s * i);
    Shot shot{fmt::format("{}@{:.3f}", name, time), camera_at(time), {}, time};
    shot.camera_at = camera_at;
    if (i > 0) shot.since_last_s = static_cast<float>(times.step_s);
    if (!arguments.output.empty())
      shot.file = fs::path(arguments.output) / fmt::format("{:04}.{}", i, arguments.format);
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
      for (const Camera& camera : pack.cameras) shots.push_back({camera.name, camera});
      continue;
    }
    ORIEL_TRY(Camera camera, parse_camera(text, choices));
    shots.push_back({camera.name.empty() || text.find('@') != std::string::npos ? text : camera.name, camera});
  }
  if (arguments.cameras.empty()) {
    const Camera camera = initial_camera(choices, scene.bounds().lower, scene.bounds().upper);
    shots.push_back({camera.name.empty() ? "start" : camera.name, camera});
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

}  // namespace oriel
