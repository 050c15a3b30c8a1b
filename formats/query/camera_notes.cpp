#include "formats/query/camera_notes.h"

#include <fmt/format.h>

#include <cmath>

namespace oriel {
namespace {

using Notes = std::map<std::string, std::string>;

std::string text_of(const DVec3& v) {
  return fmt::format("{:.12g},{:.12g},{:.12g}", v.x, v.y, v.z);
}

std::optional<DVec3> vector_of(const Notes& notes, const char* name) {
  const auto note = notes.find(name);
  if (note == notes.end()) return std::nullopt;
  DVec3 v(0);
  char rest = 0;
  if (std::sscanf(note->second.c_str(), "%lf,%lf,%lf%c", &v.x, &v.y, &v.z, &rest) != 3) return std::nullopt;
  if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) return std::nullopt;
  return v;
}

std::optional<double> number_of(const Notes& notes, const char* name) {
  const auto note = notes.find(name);
  if (note == notes.end()) return std::nullopt;
  double v = 0;
  char rest = 0;
  if (std::sscanf(note->second.c_str(), "%lf%c", &v, &rest) != 1 || !std::isfinite(v)) return std::nullopt;
  return v;
}

}  // namespace

Notes camera_notes(const Camera& camera, const DVec3& origin) {
  Notes notes{{"oriel.camera", camera.name},
              {"oriel.eye", text_of(DVec3(camera.eye) + origin)},
              {"oriel.forward", text_of(DVec3(camera.forward))},
              {"oriel.up", text_of(DVec3(camera.up))},
              {"oriel.vertical_fov_deg", fmt::format("{:.9g}", double{camera.vertical_fov_rad} * 180 / kPi)}};
  if (!(camera.vertical_fov_rad > 0)) notes["oriel.half_height"] = fmt::format("{:.9g}", camera.half_height);
  return notes;
}

std::optional<Camera> camera_of_notes(const Notes& notes, const DVec3& origin) {
  const auto eye = vector_of(notes, "oriel.eye"), forward = vector_of(notes, "oriel.forward"),
             up = vector_of(notes, "oriel.up");
  const auto fov_deg = number_of(notes, "oriel.vertical_fov_deg"), half = number_of(notes, "oriel.half_height");
  if (!eye || !forward || !up || !fov_deg || !(*fov_deg >= 0 && *fov_deg < 180)) return std::nullopt;
  if (*fov_deg == 0 && !(half && *half > 0)) return std::nullopt;
  if (!(glm::length(glm::cross(*forward, *up)) > 0)) return std::nullopt;
  Camera camera;
  if (const auto name = notes.find("oriel.camera"); name != notes.end()) camera.name = name->second;
  camera.eye = Vec3(*eye - origin);
  camera.forward = Vec3(glm::normalize(*forward));
  camera.up = Vec3(*up);
  camera.vertical_fov_rad = static_cast<float>(*fov_deg * double{kPi} / 180);
  camera.half_height = *fov_deg == 0 ? static_cast<float>(*half) : 0.0f;
  return camera;
}

}  // namespace oriel
