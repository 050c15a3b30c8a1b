// The command line of oriel-preview.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "formats/cli/command.h"
#include "player/passes/display_pass.h"
#include "preview/frame/preview_renderer.h"

namespace oriel {

struct PreviewArguments {
  PreviewSceneOptions scene;
  PreviewOptions frame;
  std::string camera;  // as written; empty: the scene's first
  int width = 1280, height = 720;
  bool offscreen = false, stats = false, reproducible = false;
  std::filesystem::path output;  // .png as shown, .exr linear
  std::uint32_t passes = 16;
  std::optional<std::uint32_t> paths;  // a pixel, after the passes; nothing: 4096 in a window, 0 offscreen
  std::optional<float> ev100;          // nothing: automatic
  ToneCurve curve = ToneCurve::kAces;
  int frames = -1;  // the window closes after so many; -1: never
  int threads = 0;
  std::uint64_t seed = 1;
  std::filesystem::path pack;             // that a bake from the window writes
  std::vector<std::string> bake_options;  // of what was given, those that oriel-bake takes too
};

// Options and what contradicts; `run` is called once they are set.
CommandLine preview_command_line(PreviewArguments& arguments, std::function<Status()> run);

}  // namespace oriel
