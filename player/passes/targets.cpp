#include "player/passes/targets.h"

#include "player/gpu/device.h"

namespace oriel {

void FrameTarget::resolve_light() const {
  if (light_samples) framebuffer.resolve_color(sampled, size());
  drawn().bind();
}

void FrameTarget::resolve_depth_stencil() const {
  if (light_samples) framebuffer.resolve_depth_stencil(sampled, size());
  drawn().bind();
}

Result<FrameTarget> make_frame_target(int width, int height, int samples, bool halves) {
  const gpu::TextureFormat& format = halves ? gpu::kRgba16f : gpu::kRgba32f;
  FrameTarget target;
  target.halves = halves;
  target.asked = samples;
  target.light = gpu::Texture2d(format, width, height, nullptr);
  target.depth = gpu::Texture2d(gpu::kDepthStencil, width, height, nullptr);
  if (samples > 1) {
    target.light_samples = gpu::MultisampleTexture(format, width, height, samples);
    target.depth_samples = gpu::MultisampleTexture(gpu::kDepthStencil, width, height, samples);
  }
  ORIEL_TRY_VOID(gpu::check_gl("making the frame's textures"));
  ORIEL_TRY(target.framebuffer, gpu::Framebuffer::create("the frame", &target.light, &target.depth, true));
  if (samples > 1) {
    ORIEL_TRY(target.sampled,
              gpu::Framebuffer::create("the frame's samples", target.light_samples, target.depth_samples));
  }
  return target;
}

void ReflectionTarget::bind(const View& view) const {
  (frame != nullptr ? frame->drawn() : image->sharp_framebuffer).bind();
  if (image != nullptr) image->sharp_framebuffer.attach_color_level(image->sharp, 0);
  glViewport(0, 0, view.width, view.height);
}

}  // namespace oriel
