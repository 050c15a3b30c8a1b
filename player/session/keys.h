// What keys and mouse do: one table for the window, for --help and for the sheet on screen.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace oriel {

enum class Action {
  kHeld,  // while it is down: the window asks for it itself
  kKeySheet,
  kPanel,
  kPresent,
  kStage,
  kFly,
  kOrbit,
  kGo,
  kHome,
  kPlayPath,
  kRecord,
  kBrighter,
  kDarker,
  kAutoExposure,
  kMoversBack,
  kScreenshot,
  kLightScreenshot,
  kReload,
  kFlip,
  kSplit,
  kNextCamera,
  kCamera,
};

// keys: their names, parted by spaces: a letter, a sign, "F1", "Home", "Backspace", with "Shift-" before it where
// that is held. "1 to 9" are the cameras'.
struct Binding {
  const char* keys;
  const char* does;
  Action action = Action::kHeld;
};

// In the order in which people look for them.
std::span<const Binding> key_bindings();

// In the order of GLFW's gamepads, which is SDL's.
enum class PadButton {
  kA,
  kB,
  kX,
  kY,
  kLeftShoulder,
  kRightShoulder,
  kBack,
  kStart,
  kGuide,
  kLeftStick,
  kRightStick,
  kUp,
  kRight,
  kDown,
  kLeft
};
inline constexpr std::size_t kPadButtons = 15;

// The same of a gamepad. kHeld: a stick, a trigger or a button while it is down, whatever `button` says.
struct PadBinding {
  const char* name;
  const char* does;
  Action action = Action::kHeld;
  PadButton button = PadButton::kA;
};
std::span<const PadBinding> pad_bindings();

// A line for each, for --help.
std::string key_help();

}  // namespace oriel
