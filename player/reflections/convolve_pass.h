// M * K (Bastos et al. 1999, section 8.2.1), with a footprint that follows the distance of what is reflected.
#pragma once

#include "player/gpu/program.h"
#include "player/reflections/image_target.h"
#include "player/scene/frame_context.h"

namespace oriel {

// Where the reflected image lies in the frame, and how fine it must be for a kernel of that median radius (0: none).
// screen: what the reflector covers.
ImageRect choose_image(const NdcRect& screen, float median, const View& view, int texture_limit, bool coarse = false);

// What shaders/passes/screen_convolve.glsl asks for, to the program in use: target.filled, all levels, and K in texture
// units 0 and 2.
void set_convolution(const gpu::Program& program, const FrameContext& context, const ReflectedImage& image);

class ConvolvePass {
 public:
  static Result<ConvolvePass> create(gpu::Dialect dialect);
  // Pixels beside the reflector (its bounds) become holes of target.sharp where something stands before its plane:
  // images know no edge. depth: of what the reflector is seen in, context.view. whole: the image is
  // of the whole scene, else of what is seen in the reflector, and past its edges what misses that is a hole too.
  void cut(const FrameContext& context, const ReflectedImage& image, const gpu::Texture2d& depth, bool whole) const;
  // target.filled, all levels, to target.blurred.
  void draw(const FrameContext& context, const ReflectedImage& image) const;

 private:
  void draw_into(const ReflectedImage& image, const gpu::Texture2d& texture, const IVec2& size) const;

  gpu::Program cut_, program_;
  gpu::VertexArray no_vertices_;
};

}  // namespace oriel
