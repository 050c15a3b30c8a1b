#include "formats/query/path.h"

#include <algorithm>

namespace oriel {
namespace {

// From unit a to unit b by the shorter way; around the vertical where they are opposite.
Vec3 slerp(const Vec3& a, const Vec3& b, float t) {
  const DVec3 from(a), to(b);
  DVec3 across = to - glm::dot(from, to) * from;
  // The angle from sine and cosine: exact for small angles too, where acos is not.
  const double sine = glm::length(across), cosine = glm::dot(from, to);
  if (sine < 1e-7) {
    if (cosine > 0) return normalize_or(glm::mix(a, b, t), a);
    across = glm::cross(std::abs(from.y) < 0.9 ? DVec3(0, 1, 0) : DVec3(1, 0, 0), from);
  }
  across = glm::normalize(across);
  const double angle = t * std::atan2(sine, cosine);
  return normalize_or(Vec3(std::cos(angle) * from + std::sin(angle) * across), a);
}

}  // namespace

float path_duration_s(const CameraPath& path) {
  return path.keys.empty() ? 0.0f : path.keys.back().time_s - path.keys.front().time_s;
}

Camera camera_on_path(const CameraPath& path, float time_s) {
  if (path.keys.empty()) return {};
  const float time = path.keys.front().time_s + (std::isnan(time_s) ? 0.0f : time_s);
  const auto after = std::upper_bound(path.keys.begin(), path.keys.end(), time,
                                      [](float t, const CameraKey& key) { return t < key.time_s; });
  const CameraKey& next = after == path.keys.end() ? path.keys.back() : *after;
  const CameraKey& previous = after == path.keys.begin() ? path.keys.front() : *(after - 1);
  const float span = next.time_s - previous.time_s;
  const float t = span > 0 ? std::clamp((time - previous.time_s) / span, 0.0f, 1.0f) : 0.0f;
  const Vec3 forward =
      slerp(normalize_or(previous.forward, Vec3(0, 0, -1)), normalize_or(next.forward, Vec3(0, 0, -1)), t);
  const Vec3 eye = glm::mix(previous.eye, next.eye, t);
  Camera camera = look_at(eye, eye + forward, path.vertical_fov_rad);
  // look_at's difference of two points would lose digits far from the origin.
  camera.forward = forward;
  return camera;
}

}  // namespace oriel
