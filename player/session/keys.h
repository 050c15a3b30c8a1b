// What keys and mouse do: one table for the window, for --help and for the sheet on screen.
#pragma once

#include <span>
#include <string>

namespace oriel {

enum class Action {
  kHeld,  // while it is down: the window asks for it itself
  kKeySheet,
  kPanel,
  kStage,
  kFly,
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

// A line for each, for --help.
std::string key_help();

}  // namespace oriel
