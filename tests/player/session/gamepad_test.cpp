// Sticks, triggers and buttons without a device.
#include "player/session/gamepad.h"

#include <gtest/gtest.h>

#include <set>

namespace oriel {
namespace {

PadState with(PadAxis axis, float value, PadState state = {}) {
  state.axes[static_cast<std::size_t>(axis)] = value;
  return state;
}
PadState holding(PadButton button) {
  PadState state;
  state.down[static_cast<std::size_t>(button)] = true;
  return state;
}
MoveInput motion(const PadState& state, float dt_s = 0.01f) {
  return pad_motion(state, {}, dt_s).move;
}

TEST(Gamepad, AtRestDoesNothing) {
  const PadMotion out = pad_motion({}, {}, 0.02f);
  EXPECT_EQ(out.move.stick, Vec3(0));
  EXPECT_EQ(out.move.mouse_x_px, 0);
  EXPECT_FALSE(out.move.fast);
  EXPECT_TRUE(out.commands.empty());
  EXPECT_EQ(motion(with(PadAxis::kLeftX, 0.1f)).stick, Vec3(0)) << "a stick that does not quite come back";
}

TEST(Gamepad, SticksBeyondTheirDeadZone) {
  EXPECT_EQ(stick_of({0.2f, 0}, 0.2f), Vec2(0));
  EXPECT_NEAR(stick_of({0.6f, 0}, 0.2f).x, 0.25f, 1e-6f) << "half of the way, squared";
  EXPECT_NEAR(glm::length(stick_of({1, 1}, 0.2f)), 1, 1e-6f) << "corners are no faster";
  const Vec2 slant = stick_of({-0.3f, 0.4f}, 0.1f);
  EXPECT_NEAR(slant.y / slant.x, -4 / 3.0f, 1e-5f) << "the direction stays";
  EXPECT_EQ(stick_of({std::nanf(""), 1}, 0.1f), Vec2(0));
}

TEST(Gamepad, WalksLooksAndRises) {
  EXPECT_NEAR(motion(with(PadAxis::kLeftY, -1)).stick.z, 1, 1e-6f) << "up is ahead";
  EXPECT_NEAR(motion(with(PadAxis::kLeftX, 1)).stick.x, 1, 1e-6f);
  EXPECT_NEAR(motion(with(PadAxis::kRightTrigger, 1)).stick.y, 1, 1e-6f);
  EXPECT_NEAR(motion(with(PadAxis::kLeftTrigger, 1)).stick.y, -1, 1e-6f);
  EXPECT_NEAR(motion(with(PadAxis::kRightX, 1), 0.05f).mouse_x_px, 50, 1e-4f);
  EXPECT_NEAR(motion(with(PadAxis::kRightY, 1), 100).mouse_y_px, 100, 1e-4f) << "a long frame turns no farther";
  EXPECT_TRUE(motion(holding(PadButton::kLeftShoulder)).fast);
  const MoveInput broken = motion(with(PadAxis::kLeftX, std::nanf(""), with(PadAxis::kRightTrigger, INFINITY)), NAN);
  EXPECT_EQ(broken.stick, Vec3(0));
  EXPECT_EQ(broken.mouse_x_px, 0);
}

TEST(Gamepad, ButtonsCountOnceWhenTheyGoDown) {
  std::set<PadButton> taken;
  for (const PadBinding& binding : pad_bindings()) {
    EXPECT_NE(key_help().find(binding.does), std::string::npos);
    if (binding.action == Action::kHeld) continue;
    EXPECT_TRUE(taken.insert(binding.button).second) << binding.name;
    const PadState down = holding(binding.button);
    const auto pressed = pad_motion(down, {}, 0.01f).commands;
    ASSERT_EQ(pressed.size(), 1u) << binding.name;
    EXPECT_EQ(pressed[0].action, binding.action);
    EXPECT_TRUE(pad_motion(down, down, 0.01f).commands.empty()) << "still down";
    EXPECT_TRUE(pad_motion({}, down, 0.01f).commands.empty()) << "let go";
  }
}

}  // namespace
}  // namespace oriel
