// A gamepad as motion and commands. No window: it is given what the device says.
#pragma once

#include <array>
#include <vector>

#include "player/session/session.h"

namespace oriel {

enum class PadAxis { kLeftX, kLeftY, kRightX, kRightY, kLeftTrigger, kRightTrigger };
inline constexpr std::size_t kPadAxes = 6;

struct PadState {
  // Sticks: [-1,1], right and down are positive. Triggers: -1 let go, 1 pulled. Values that are not finite are 0.
  std::array<float, kPadAxes> axes{0, 0, 0, 0, -1, -1};
  std::array<bool, kPadButtons> down{};
};

struct PadOptions {
  float dead_zone = 0.15f;  // of a stick's way around its middle, and of a trigger's: no stick comes quite back
  float turn_px_per_s = 1000;
};

// What is added to keys and mouse.
struct PadMotion {
  MoveInput move;                 // stick, mouse_x_px, mouse_y_px, fast
  std::vector<Command> commands;  // of buttons that have gone down
};
PadMotion pad_motion(const PadState& now, const PadState& before, float dt_s, const PadOptions& options = {});

// A stick beyond its dead zone: from 0 at its edge to 1 at the end, the same direction; squared, so that small ways
// turn slowly.
Vec2 stick_of(const Vec2& raw, float dead_zone);

}  // namespace oriel
