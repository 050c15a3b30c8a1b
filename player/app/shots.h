// Which frames are drawn without a window, and into which files.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "player/scene/gpu_scene.h"
#include "player/session/arguments.h"

namespace oriel {

struct Shot {
  std::string name;
  Camera camera;
  std::string file{};  // empty: none
  float time_s = 0;    // into the path, which the movers' clock follows
  // Since the frame before, to which eyes are adapted; infinite where there is none.
  float since_last_s = std::numeric_limits<float>::infinity();
  std::function<Camera(float time_s)> camera_at{};  // of one that moves; none: it stays
};

// Along arguments.path, at even times; files only where a folder was given, which is made. Errors: kUsage, kIo,
// kInvalid.
Result<std::vector<Shot>> path_shots(const GpuScene& scene, const PlayArguments& arguments);

// Of arguments.cameras, or the one to start with. Errors: kUsage, kIo.
Result<std::vector<Shot>> choose_shots(const GpuScene& scene, const PlayArguments& arguments);

}  // namespace oriel
