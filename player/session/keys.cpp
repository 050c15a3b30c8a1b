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
    {"L, drag a lamp", "moves a light group along its level; with R it turns"},
    {"Backspace", "all movers and lamps back", Action::kMoversBack},
    {"double click", "walk there, or as near as one comes; so does the middle button, and any motion ends it"},
    {"G", "the same to what is in the middle of the view", Action::kGo},
    {"F", "fly or walk", Action::kFly},
    {"O", "turn around what is in the middle of the view; W S and the wheel come nearer", Action::kOrbit},
    {"1 to 9", "the scene's cameras", Action::kCamera},
    {"C", "the next of them", Action::kNextCamera},
    {"Home", "back to where it began", Action::kHome},
    {"P", "play the path, or stop it", Action::kPlayPath},
    {"F9", "record a walk, or end it into a file", Action::kRecord},
    {"+", "brighter", Action::kBrighter},
    {"-", "darker", Action::kDarker},
    {"X", "automatic exposure", Action::kAutoExposure},
    {"M", "next stage: M, M*K, times R, D; illuminance, error, texels, charts; the frame", Action::kStage},
    {"B", "beside each other: two packs, or a pack and a picture; the divider is dragged", Action::kSplit},
    {"V", "one of the two, and the other", Action::kFlip},
    {"Tab", "panel", Action::kPanel},
    {"F11", "presentation: the whole screen, no words; Esc ends it", Action::kPresent},
    {"F1", "this sheet", Action::kKeySheet},
    {"F12", "screenshot into this folder", Action::kScreenshot},
    {"Shift-F12", "the same in linear light, as EXR", Action::kLightScreenshot},
    {"F5", "the pack's file again, seen from here", Action::kReload},
    {"Esc, Ctrl-Q", "quit"},
};

constexpr PadBinding kPadBindings[] = {
    {"left stick", "walk"},
    {"right stick", "look"},
    {"triggers", "down and up, while flying"},
    {"left shoulder", "faster"},
    {"right shoulder", "the next camera", Action::kNextCamera, PadButton::kRightShoulder},
    {"A", "walk to what is in the middle of the view", Action::kGo, PadButton::kA},
    {"B", "turn around it", Action::kOrbit, PadButton::kB},
    {"X", "play the path, or stop it", Action::kPlayPath, PadButton::kX},
    {"Y", "fly or walk", Action::kFly, PadButton::kY},
    {"start", "back to where it began", Action::kHome, PadButton::kStart},
    {"back", "the sheet of keys", Action::kKeySheet, PadButton::kBack},
    {"up", "brighter", Action::kBrighter, PadButton::kUp},
    {"down", "darker", Action::kDarker, PadButton::kDown},
    {"right", "next stage", Action::kStage, PadButton::kRight},
    {"left", "automatic exposure", Action::kAutoExposure, PadButton::kLeft},
};

}  // namespace

std::span<const PadBinding> pad_bindings() {
  return kPadBindings;
}

std::span<const Binding> key_bindings() {
  return kBindings;
}

std::string key_help() {
  std::string out;
  for (const Binding& b : kBindings) out += fmt::format("  {:<15}{}\n", b.keys, b.does);
  out += "\nWith a gamepad:\n";
  for (const PadBinding& b : kPadBindings) out += fmt::format("  {:<15}{}\n", b.name, b.does);
  return out;
}

}  // namespace oriel
