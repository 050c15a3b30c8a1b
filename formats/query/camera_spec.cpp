#include "formats/query/camera_spec.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

#include "formats/query/path.h"

namespace oriel {
namespace {

constexpr float kDefaultFovRad = 1.0471976f;  // 60°
constexpr double kRounded = 0.005;            // of a path's duration, as messages round it

// The whole text as a finite number, whatever the locale.
std::optional<double> number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<std::size_t> index(std::string_view text) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::string known(const CameraChoices& choices) {
  std::string text;
  for (std::size_t i = 0; i < choices.cameras.size(); ++i) {
    text += fmt::format("{}{} \"{}\"", text.empty() ? "" : ", ", i, choices.cameras[i].name);
  }
  for (const CameraPath& path : choices.paths) {
    text += fmt::format("{}\"{}@SECONDS\" (0 to {:.3g})", text.empty() ? "" : ", ", path.name, path_duration_s(path));
  }
  return text.empty() ? "the pack has no camera, only ex,ey,ez,tx,ty,tz" : text + ", or ex,ey,ez,tx,ty,tz";
}

tl::unexpected<Error> unknown(std::string_view text, const CameraChoices& choices) {
  return fail(ErrorCode::kUsage, "camera", "found \"{}\", expected one of: {}", text, known(choices));
}

Result<Camera> parse_points(std::string_view text, const CameraChoices& choices) {
  std::array<double, 6> values{};
  std::size_t count = 0;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    const auto value = number(text.substr(at, comma - at));
    if (!value) return unknown(text, choices);
    if (count < values.size()) values[count] = *value;
    ++count;
    at = comma + 1;
  }
  if (count != values.size()) {
    return fail(ErrorCode::kUsage, "camera", "found {} numbers in \"{}\", expected 6: ex,ey,ez,tx,ty,tz", count, text);
  }
  const DVec3 eye(values[0], values[1], values[2]), target(values[3], values[4], values[5]);
  const Vec3 pack_eye(eye - choices.origin), forward = normalize_or(Vec3(target - eye), Vec3(0));
  if (!is_finite(pack_eye) || forward == Vec3(0)) {
    return fail(ErrorCode::kUsage, "camera", "found eye and target of \"{}\" at one point or too far, expected two",
                text);
  }
  Camera camera = look_at(Vec3(0), forward, kDefaultFovRad);
  camera.eye = pack_eye;
  return camera;
}

}  // namespace

Result<Camera> parse_camera(std::string_view text, const CameraChoices& choices) {
  for (const Camera& camera : choices.cameras) {
    if (camera.name == text) return camera;
  }
  if (const auto i = index(text)) {
    if (*i < choices.cameras.size()) return choices.cameras[*i];
    return unknown(text, choices);
  }
  if (const std::size_t split = text.rfind('@'); split != std::string_view::npos) {
    const auto time = number(text.substr(split + 1));
    for (const CameraPath& path : choices.paths) {
      if (!time || path.name != text.substr(0, split)) continue;
      const double most = double{path_duration_s(path)};
      if (*time < 0 || *time > most + kRounded * most)
        return fail(ErrorCode::kUsage, "camera", "found {:g} s on path \"{}\", expected 0 to {:.4g}", *time, path.name,
                    most);
      return camera_on_path(path, static_cast<float>(*time));
    }
    return unknown(text, choices);
  }
  if (text.find(',') != std::string_view::npos) return parse_points(text, choices);
  return unknown(text, choices);
}

Camera initial_camera(const CameraChoices& choices, const Vec3& lower, const Vec3& upper) {
  if (!choices.cameras.empty()) return choices.cameras.front();
  if (!choices.paths.empty()) return camera_on_path(choices.paths.front(), 0);
  return overview(lower, upper, 0);
}

}  // namespace oriel
