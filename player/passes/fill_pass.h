// Holes of the reflected image: pulled to coarser levels from what is there, pushed back to where nothing is.
#pragma once

#include "player/gpu/program.h"
#include "player/scene/frame_options.h"
#include "player/passes/targets.h"

namespace oriel {

class FillPass {
 public:
  static Result<FillPass> create(gpu::Dialect dialect);
  // Fills target.filled, all levels, from level 0 of target.sharp. No pixel of the image keeps a = 0 unless all have it.
  void draw(const ImageRect& rect, const ImageTarget& target, FrameStats& stats) const;

 private:
  gpu::Program pull_, push_;
  gpu::VertexArray no_vertices_;
};

}  // namespace oriel
