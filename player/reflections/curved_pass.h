// Reflections on curved surfaces, drawn straight into the frame: their images are as curved as they are, so that there
// is none to make first.
#pragma once

#include "player/gpu/program.h"
#include "player/gpu/raster_state.h"
#include "player/navigation/view.h"
#include "player/scene/frame_options.h"
#include "player/scene/gpu_scene.h"

namespace oriel {

class CurvedPass {
 public:
  static Result<CurvedPass> create(gpu::Dialect dialect);

  // Where the frame's depth leaves the reflector visible, its pixels get `value` in the bits `bits` of the stencil.
  void draw_mask(const GpuScene& scene, const GpuCurvedReflector& reflector, const View& view, GLint value, GLuint bits,
                 FrameStats& stats) const;
  // (M * K) R there, or the stage that options ask for: into the frame, with `value` in those bits of the stencil; or,
  // with bits 0, added to the frame.
  void draw_light(GpuScene& scene, const GpuCurvedReflector& reflector, const View& view, GLint value, GLuint bits,
                  const FrameOptions& options, FrameStats& stats) const;

 private:
  gpu::Program mask_, light_;
};

}  // namespace oriel
