// A frame in the stages that are compared with a reference.
#pragma once

#include "formats/image/comparison.h"
#include "player/passes/frame.h"

namespace oriel {

struct ComparedView {
  GpuScene& scene;
  const View& view;  // of `parts` times as many pixels a side as the reference has
  const FrameOptions& options;
  std::uint32_t parts = 1;
  FrameExtension* extension = nullptr;
};

// Draws each stage as a large picture, and averages its pixels to the reference's. Errors of frames.
Result<PlayedFrame> draw_compared(Renderer& renderer, const ComparedView& of);

}  // namespace oriel
