// What is drawn over the preview: what is wrong with the file, how far the light is, and the switches.
#pragma once

#include <string>

#include "player/navigation/controller.h"
#include "preview/frame/preview_renderer.h"

namespace oriel {

// What the window tells, and what the panel changes.
struct PreviewStatus {
  std::string error;    // of the file's last reading; empty: none
  std::string message;  // news
  std::uint32_t passes = 0, most_passes = 0, paths = 0, most_paths = 0;
  double noise = 1;   // of the paths, relative
  double pass_s = 0;  // of the last one
  std::size_t triangles = 0, lamps = 0;
  bool panel = false;
  bool loading = true;  // no scene yet
};

// Between Gui::begin and Gui::end. True where a switch changed: the frame begins anew.
bool draw_preview_overlay(const PreviewStatus& status, PreviewOptions& options);

}  // namespace oriel
