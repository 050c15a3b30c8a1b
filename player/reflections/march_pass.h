// M: what a reflector sees, by marching each pixel's reflected ray through its radiance maps.
#pragma once

#include "player/gpu/program.h"
#include "player/reflections/image_target.h"
#include "player/scene/frame_context.h"

namespace oriel {

class MarchPass {
 public:
  static Result<MarchPass> create(gpu::Dialect dialect);

  // Clears the image and draws what it takes to show the reflector, whose front faces the eye: of a mirror the
  // pixels that show it, of an image that blurs also what lies around, on its plane beyond its edges. Where half the
  // kernel covers two pixels of rect.marched or more they are that large, and interpolated. What no map sees keeps a =
  // 0.
  void draw(const FrameContext& context, const ReflectedImage& image, const ShownPixels& shown) const;

 private:
  // Into what is bound, in pixels of `coarse` of the image's.
  void march(const FrameContext& context, const ReflectedImage& image, int coarse) const;
  // Coarse pixels over all of the image but those that show the reflector and are blurred less: those alone keep their
  // value in its stencil.
  void draw_coarse(const FrameContext& context, const ReflectedImage& image, const ShownPixels& shown) const;
  void choose_maps(const FrameContext& context, const ReflectorElement& element, const MapArray& array,
                   const Vec4& mirrored_eye) const;
  gpu::Program program_, spread_, spread_everywhere_;
  gpu::VertexArray no_vertices_;
};

}  // namespace oriel
