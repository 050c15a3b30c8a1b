#include "player/session/gamepad.h"

#include <algorithm>
#include <cmath>

namespace oriel {
namespace {

float value(const PadState& state, PadAxis axis) {
  const float v = state.axes[static_cast<std::size_t>(axis)];
  return std::isfinite(v) ? std::clamp(v, -1.0f, 1.0f) : 0.0f;
}

// [0, 1] beyond the dead zone.
float trigger(const PadState& state, PadAxis axis, float dead_zone) {
  const float v = state.axes[static_cast<std::size_t>(axis)];
  const float pulled = std::isfinite(v) ? std::clamp(0.5f * (v + 1), 0.0f, 1.0f) : 0.0f;
  return std::max(pulled - dead_zone, 0.0f) / (1 - dead_zone);
}

}  // namespace

Vec2 stick_of(const Vec2& raw, float dead_zone) {
  const float length = glm::length(raw);
  if (!(length > dead_zone)) return Vec2(0);
  const float share = std::min((length - dead_zone) / (1 - dead_zone), 1.0f);
  return raw / length * (share * share);
}

PadMotion pad_motion(const PadState& now, const PadState& before, float dt_s, const PadOptions& options) {
  PadMotion out;
  const Vec2 walk = stick_of({value(now, PadAxis::kLeftX), value(now, PadAxis::kLeftY)}, options.dead_zone);
  const Vec2 look = stick_of({value(now, PadAxis::kRightX), value(now, PadAxis::kRightY)}, options.dead_zone);
  const float rise =
      trigger(now, PadAxis::kRightTrigger, options.dead_zone) - trigger(now, PadAxis::kLeftTrigger, options.dead_zone);
  out.move.stick = {walk.x, rise, -walk.y};
  const float turn = options.turn_px_per_s * std::clamp(std::isfinite(dt_s) ? dt_s : 0.0f, 0.0f, 0.1f);
  out.move.mouse_x_px = turn * look.x;
  out.move.mouse_y_px = turn * look.y;
  out.move.fast = now.down[static_cast<std::size_t>(PadButton::kLeftShoulder)];
  for (const PadBinding& binding : pad_bindings()) {
    const auto button = static_cast<std::size_t>(binding.button);
    const bool pressed = binding.action != Action::kHeld && now.down[button] && !before.down[button];
    if (pressed) out.commands.push_back({binding.action, 0});
  }
  return out;
}

}  // namespace oriel
