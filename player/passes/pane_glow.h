// The light of points, spots and suns that frosted panes spread to the eye.
#pragma once

#include "player/gpu/program.h"
#include "player/scene/frame_context.h"

namespace oriel {

class PaneGlow {
 public:
  static Result<PaneGlow> create(gpu::Dialect dialect);

  // Added to what a body shows, where it is lit from the other side than the eye is on. The frame is bound.
  void draw(const FrameContext& context, const GlassBody& body) const;

 private:
  gpu::Program program_;
};

}  // namespace oriel
