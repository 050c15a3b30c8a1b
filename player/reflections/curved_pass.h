// Reflections on curved surfaces. Their light is found once by pixel, from where they are and how they are turned
// there, and then drawn: shaded triangle by triangle, dense meshes cost a block of pixels for each triangle.
#pragma once

#include <span>

#include "player/gpu/framebuffer.h"
#include "player/gpu/program.h"
#include "player/gpu/raster_state.h"
#include "player/scene/frame_context.h"

namespace oriel {

class CurvedPass {
 public:
  static Result<CurvedPass> create(gpu::Dialect dialect);

  // An opaque one in view, and what it is called in the stencil, from 1.
  struct Shown {
    const GpuCurvedReflector* reflector = nullptr;
    GLint value = 0;
  };

  // Where the frame's depth leaves the reflector visible, its pixels get `value` in the bits `bits` of the stencil.
  void draw_mask(const FrameContext& context, const GpuCurvedReflector& reflector, GLint value, GLuint bits) const;
  // M * K of opaque ones at the middle of each pixel, into images of its own. Leaves its own framebuffer bound.
  Status shade(const FrameContext& context, std::span<const Shown> shown);
  // (M * K) R, or the stage that options ask for, into the frame: of one that shade() has shaded, with its value in
  // those bits of the stencil;
  void draw_shaded(const FrameContext& context, const Shown& shown, GLuint bits) const;
  // of a see-through one, added to the frame.
  void add_light(const FrameContext& context, const GpuCurvedReflector& reflector) const;

 private:
  // As large as the largest frame so far.
  struct Canvas {
    gpu::Texture2d places, normals, depth, light;
    gpu::Framebuffer surfaces, shaded;
    Status make(int width, int height);
  };
  void draw_surface(const FrameContext& context, const Shown& shown) const;
  void set_lobe(const gpu::Program& program, const FrameContext& context, const GpuCurvedReflector& reflector) const;
  void set_reflectance(const gpu::Program& program, const FrameContext& context,
                       const GpuCurvedReflector& reflector) const;

  gpu::Program mask_, surface_, shade_, light_, shaded_light_;
  gpu::VertexArray no_vertices_;
  Canvas canvas_;
};

}  // namespace oriel
