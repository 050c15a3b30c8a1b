#include "player/session/keys.h"

#include <fmt/format.h>

namespace oriel {
namespace {

constexpr Binding kBindings[] = {
    {"W A S D", "walk"},
    {"Q E", "down and up, while flying"},
    {"Shift", "faster"},
    {"wheel", "walking speed"},
    {"mouse, arrows", "look; a click grabs the mouse, Esc releases it"},
    {"drag a mover", "moves it along its level; with R it turns"},
    {"Backspace", "all movers back", Action::kMoversBack},
    {"F", "fly or walk", Action::kFly},
    {"1 to 9", "the scene's cameras", Action::kCamera},
    {"Home", "back to where it began", Action::kHome},
    {"P", "play the path, or stop it", Action::kPlayPath},
    {"F9", "record a walk, or end it into a file", Action::kRecord},
    {"+", "brighter", Action::kBrighter},
    {"-", "darker", Action::kDarker},
    {"X", "automatic exposure", Action::kAutoExposure},
    {"M", "next stage: M, M*K, times R, D; illuminance, error, texels; the frame", Action::kStage},
    {"Tab", "panel", Action::kPanel},
    {"F1", "this sheet", Action::kKeySheet},
    {"F12", "screenshot into this folder", Action::kScreenshot},
    {"Shift-F12", "the same in linear light, as EXR", Action::kLightScreenshot},
    {"F5", "the pack's file again, seen from here", Action::kReload},
    {"Esc, Ctrl-Q", "quit"},
};

}  // namespace

std::span<const Binding> key_bindings() {
  return kBindings;
}

std::string key_help() {
  std::string out;
  for (const Binding& b : kBindings) out += fmt::format("  {:<15}{}\n", b.keys, b.does);
  return out;
}

}  // namespace oriel
