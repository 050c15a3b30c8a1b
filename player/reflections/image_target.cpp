#include "player/reflections/image_target.h"

#include <algorithm>
#include <bit>

#include "player/gpu/device.h"
#include "player/gpu/raster_state.h"

namespace oriel {

Vec4 ndc_from_image(const ImageRect& rect, const View& view) {
  const Vec2 size(static_cast<float>(view.width), static_cast<float>(view.height));
  const Vec2 scale = 2.0f / size;
  const Vec2 offset = 2.0f * rect.origin / size - 1.0f;
  return Vec4(scale, offset);
}

Status ensure_image_target(std::optional<ImageTarget>& current, int width, int height, int limit, bool halves) {
  if (current && current->halves == halves && current->sharp.width() >= width && current->sharp.height() >= height)
    return {};
  const auto rounded = [&](int size, int had) {
    const int wanted = std::max(size, had);
    return static_cast<int>(
        std::min(std::bit_ceil(static_cast<unsigned>(wanted)), std::bit_floor(static_cast<unsigned>(limit))));
  };
  const int w = rounded(width, current ? current->sharp.width() : 16);
  const int h = rounded(height, current ? current->sharp.height() : 16);
  if (w < width || h < height) {
    return fail(ErrorCode::kRuntime, "reflected image", "found {}x{} pixels, expected at most {}", width, height,
                limit);
  }
  current.reset();
  const gpu::TextureFormat& format = halves ? gpu::kRgba16f : gpu::kRgba32f;
  ImageTarget target;
  target.halves = halves;
  gpu::TextureOptions options;
  options.levels = gpu::mip_levels(w, h);
  target.sharp = gpu::Texture2d(format, w, h, nullptr, options);
  options.mag_filter = GL_LINEAR;
  options.min_filter = GL_LINEAR_MIPMAP_NEAREST;  // dozens of taps a pixel need no blend of levels
  target.filled = gpu::Texture2d(format, w, h, nullptr, options);
  gpu::TextureOptions linear;
  linear.min_filter = linear.mag_filter = GL_LINEAR;
  target.blurred = gpu::Texture2d(format, w, h, nullptr, linear);
  target.depth = gpu::Texture2d(gpu::kDepthStencil, w, h, nullptr);
  ORIEL_TRY_VOID(gpu::check_gl("making the reflected image's textures"));
  ORIEL_TRY(target.sharp_framebuffer, gpu::Framebuffer::create("reflected image", &target.sharp, &target.depth, true));
  ORIEL_TRY(target.level_framebuffer,
            gpu::Framebuffer::create("levels of the reflected image", &target.filled, nullptr));
  current = std::move(target);
  return {};
}

void clear_image(const ImageTarget& target, const ImageRect& rect, const Vec4& light) {
  target.sharp_framebuffer.bind();
  target.sharp_framebuffer.attach_color_level(target.sharp, 0);
  gpu::RasterState state;
  state.depth_test = state.depth_write = true;
  state.stencil_write = 0xff;
  gpu::apply(state);
  glViewport(0, 0, rect.width, rect.height);
  glEnable(GL_SCISSOR_TEST);
  glScissor(0, 0, rect.width, rect.height);
  glClearColor(light.x, light.y, light.z, light.w);
  glClearStencil(0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
  glDisable(GL_SCISSOR_TEST);
}

void copy_stencil(const ImageTarget& target, const ImageRect& rect, const gpu::Framebuffer& frame, const View& view) {
  const IVec2 origin(rect.origin), size(rect.width, rect.height);
  const IVec2 lower = glm::max(origin, IVec2(0)), upper = glm::min(origin + size, IVec2(view.width, view.height));
  if (lower.x >= upper.x || lower.y >= upper.y) return;
  target.sharp_framebuffer.bind();
  target.sharp_framebuffer.copy_depth_stencil(frame, lower, upper - lower, lower - origin);
}

}  // namespace oriel
