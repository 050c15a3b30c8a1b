#include "player/navigation/controller.h"

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

float notches(const MoveInput& input) {
  return std::clamp(finite_or_zero(input.wheel), -100.0f, 100.0f);
}

// Right, up, ahead: keys and stick, each [-1,1].
Vec3 wanted(const MoveInput& input) {
  const Vec3 keys(axis(input.right, input.left), axis(input.up, input.down), axis(input.forward, input.back));
  const Vec3 stick(finite_or_zero(input.stick.x), finite_or_zero(input.stick.y), finite_or_zero(input.stick.z));
  return glm::clamp(keys + stick, Vec3(-1), Vec3(1));
}

Camera orbited(const Camera& camera, MoveState& state, MoveInput input, float dt_s, const MoveOptions& options) {
  const Vec3 by = wanted(input), centre = *state.orbit;
  const float factor = input.fast ? options.fast_factor : 1.0f;
  const float turn_px = factor * options.orbit_rad_per_s * dt_s / options.radians_per_pixel;
  input.mouse_x_px = finite_or_zero(input.mouse_x_px) - by.x * turn_px;
  input.mouse_y_px = finite_or_zero(input.mouse_y_px) + by.y * turn_px;
  Camera next = turned(camera, input, options);
  const float here = glm::distance(camera.eye, centre);
  const float zoom =
      std::exp(-by.z * factor * options.zoom_per_s * dt_s) * std::pow(options.wheel_factor, -notches(input));
  // From where it is: a wall may have held it nearer than it was to be.
  if (state.orbit_m <= 0 || zoom < 1) state.orbit_m = here;
  const float distance = std::max(state.orbit_m * zoom, options.nearest_orbit_m);
  const Vec3 eye = centre - next.forward * distance;
  if (!is_finite(eye)) return next;
  state.orbit_m = distance;
  next.eye = eye;
  return next;
}

}  // namespace

Camera move_camera(const Camera& camera, MoveState& state, const MoveInput& input, float dt_s,
                   const MoveOptions& options) {
  const float dt = std::clamp(finite_or_zero(dt_s), 0.0f, options.max_step_s);
  if (state.orbit) return orbited(camera, state, input, dt, options);
  const float speed = finite_or_zero(state.speed_m_s) * std::pow(options.wheel_factor, notches(input));
  state.speed_m_s = std::clamp(speed, options.min_speed_m_s, options.max_speed_m_s);

  Camera next = turned(camera, input, options);
  next.forward = normalize_or(next.forward, Vec3(0, 0, -1));
  Vec3 by = wanted(input);
  if (!state.fly) by.y = 0;
  if (by == Vec3(0)) return next;

  const float yaw = yaw_of(next);
  const Vec3 right(std::cos(yaw), 0, -std::sin(yaw));
  const Vec3 direction = (state.fly ? next.forward : forward_from(yaw, 0)) * by.z + right * by.x + Vec3(0, by.y, 0);
  const float share = std::min(glm::length(by), 1.0f);  // of the speed
  const float distance = share * state.speed_m_s * (input.fast ? options.fast_factor : 1.0f) * dt;
  const Vec3 eye = next.eye + normalize_or(direction, Vec3(0)) * distance;
  if (is_finite(eye)) next.eye = eye;
  return next;
}

}  // namespace oriel
