// The frame that passes draw into.
#pragma once

#include "player/gpu/framebuffer.h"

namespace oriel {

// The frame: light in cd/m² (a: 0 nothing, 1 light, 2 a colour to be shown as it is), depth, stencil.
struct FrameTarget {
  gpu::Texture light, depth;
  gpu::Framebuffer framebuffer;
};
Result<FrameTarget> make_frame_target(int width, int height);

}  // namespace oriel
