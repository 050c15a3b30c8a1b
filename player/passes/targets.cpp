#include "player/passes/targets.h"

#include "player/gpu/device.h"

namespace oriel {

Result<FrameTarget> make_frame_target(int width, int height) {
  FrameTarget target;
  target.light = gpu::Texture(gpu::kRgba32f, width, height, nullptr);
  target.depth = gpu::Texture(gpu::kDepthStencil, width, height, nullptr);
  ORIEL_TRY_VOID(gpu::check_gl("making the frame's textures"));
  ORIEL_TRY(target.framebuffer, gpu::Framebuffer::create("the frame", &target.light, &target.depth, true));
  return target;
}

}  // namespace oriel
