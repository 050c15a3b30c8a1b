#include "player/walk/controller.h"

#include <algorithm>

namespace oriel {
namespace {

float finite_or_zero(float value) {
  return std::isfinite(value) ? value : 0.0f;
}

float axis(bool positive, bool negative) {
  return (positive ? 1.0f : 0.0f) - (negative ? 1.0f : 0.0f);
}

Camera turned(Camera camera, const MoveInput& input, const MoveOptions& options) {
  const float dx = finite_or_zero(input.mouse_x_px) * options.radians_per_pixel;
  const float dy = finite_or_zero(input.mouse_y_px) * options.radians_per_pixel;
  if (dx == 0 && dy == 0) return camera;
  // Whole turns off before cos and sin: a mouse that jumped by 1e30 pixels still gives an angle.
  const float yaw = std::remainder(yaw_of(camera) - dx, 2 * kPi);
  const float pitch = std::clamp(pitch_of(camera) - dy, -options.max_pitch_rad, options.max_pitch_rad);
  camera.forward = glm::normalize(forward_from(finite_or_zero(yaw), pitch));
  camera.up = Vec3(0, 1, 0);
  return camera;
}

}  // namespace

Camera move_camera(const Camera& camera, MoveState& state, const MoveInput& input, float dt_s,
                   const MoveOptions& options) {
  const float notches = std::clamp(finite_or_zero(input.wheel), -100.0f, 100.0f);
  const float speed = finite_or_zero(state.speed_m_s) * std::pow(options.wheel_factor, notches);
  state.speed_m_s = std::clamp(speed, options.min_speed_m_s, options.max_speed_m_s);

  Camera next = turned(camera, input, options);
  next.forward = normalize_or(next.forward, Vec3(0, 0, -1));
  const float ahead = axis(input.forward, input.back), aside = axis(input.right, input.left);
  const float rise = state.fly ? axis(input.up, input.down) : 0.0f;
  if (ahead == 0 && aside == 0 && rise == 0) return next;

  const float yaw = yaw_of(next);
  const Vec3 right(std::cos(yaw), 0, -std::sin(yaw));
  const Vec3 direction = (state.fly ? next.forward : forward_from(yaw, 0)) * ahead + right * aside + Vec3(0, rise, 0);
  const float dt = std::clamp(finite_or_zero(dt_s), 0.0f, options.max_step_s);
  const float distance = state.speed_m_s * (input.fast ? options.fast_factor : 1.0f) * dt;
  const Vec3 eye = next.eye + normalize_or(direction, Vec3(0)) * distance;
  if (is_finite(eye)) next.eye = eye;
  return next;
}

}  // namespace oriel
