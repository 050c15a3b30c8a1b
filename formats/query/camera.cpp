#include "formats/query/camera.h"

#include <algorithm>

namespace oriel {
namespace {

constexpr float kVertical = 0.99999f;  // |forward.y| from which a camera counts as vertical

}  // namespace

Camera look_at(const Vec3& eye, const Vec3& target, float vertical_fov_rad) {
  Camera camera;
  camera.eye = eye;
  camera.forward = normalize_or(Vec3(DVec3(target) - DVec3(eye)), Vec3(0, 0, -1));
  camera.vertical_fov_rad = vertical_fov_rad;
  if (std::abs(camera.forward.y) > kVertical) camera.up = Vec3(0, 0, camera.forward.y > 0 ? 1 : -1);
  return camera;
}

Camera overview(const Vec3& lower, const Vec3& upper, float turn_rad, bool from_above) {
  constexpr float kFovRad = kPi / 3;
  const Vec3 size = upper - lower, centre = lower + 0.5f * size;
  const float distance = 0.55f * glm::length(size) / std::sin(0.5f * kFovRad),
              turn = turn_rad + std::atan2(0.5f, 0.85f);
  const Vec3 towards_eye = -forward_from(turn, from_above ? -0.43f : 0.43f);
  return look_at(centre + distance * towards_eye, centre, kFovRad);
}

float yaw_of(const Camera& camera) {
  const Vec3 forward = normalize_or(camera.forward, Vec3(0, 0, -1));
  const bool vertical = std::abs(forward.y) > kVertical;
  // Looking down, the top of the picture is ahead; looking up, behind.
  const Vec3 ahead = !vertical ? forward : forward.y < 0 ? camera.up : -camera.up;
  return ahead.x == 0 && ahead.z == 0 ? 0.0f : std::atan2(-ahead.x, -ahead.z);
}

float pitch_of(const Camera& camera) {
  return std::asin(std::clamp(normalize_or(camera.forward, Vec3(0, 0, -1)).y, -1.0f, 1.0f));
}

Vec3 forward_from(float yaw_rad, float pitch_rad) {
  const float level = std::cos(pitch_rad);
  return Vec3(-std::sin(yaw_rad) * level, std::sin(pitch_rad), -std::cos(yaw_rad) * level);
}

Mat3 pack_from_eye_axes(const Camera& camera) {
  const DVec3 back(-normalize_or(camera.forward, Vec3(0, 0, -1)));
  DVec3 right = glm::cross(DVec3(normalize_or(camera.up, Vec3(0, 1, 0))), back);
  if (glm::dot(right, right) < 1e-12) right = DVec3(frame_from_normal(Vec3(back))[0]);
  right = glm::normalize(right);
  return Mat3(Vec3(right), Vec3(glm::cross(back, right)), Vec3(back));
}

PixelRay pixel_ray(const Camera& camera, float x, float y, float width, float height) {
  const Mat3 axes = pack_from_eye_axes(camera);
  const double sx = (2.0 * x / width - 1.0) * width / height, sy = 1.0 - 2.0 * y / height;
  if (camera.vertical_fov_rad > 0) {
    const double scale = std::tan(0.5 * camera.vertical_fov_rad);
    return {camera.eye, Vec3(glm::normalize(DMat3(axes) * DVec3(sx * scale, sy * scale, -1)))};
  }
  const double half_height = camera.half_height > 0 ? camera.half_height : 1.0;
  return {camera.eye + axes * Vec3(DVec3(sx * half_height, sy * half_height, 0)), -axes[2]};
}

}  // namespace oriel
