// What the passes of a frame share.
#pragma once

#include "player/navigation/view.h"
#include "player/scene/frame_options.h"
#include "player/scene/gpu_scene.h"

namespace oriel {

struct FrameContext {
  GpuScene& scene;
  const View& view;  // of the frame, or of the image that is drawn for it
  const FrameOptions& options;
  FrameStats& stats;
};

}  // namespace oriel
