// Holes of the reflected image: pulled to coarser levels from what is there, pushed back to where nothing is.
#pragma once

#include "player/gpu/program.h"
#include "player/reflections/image_target.h"
#include "player/scene/frame_options.h"

namespace oriel {

class FillPass {
 public:
  static Result<FillPass> create(gpu::Dialect dialect);
  // What a hole is: something that nearer things hid, so that what lies behind flows into it from far around, or a
  // place beside the reflector, which shows what the reflector does next to it.
  enum class Holes { kHidden, kBeside };
  // Fills target.filled from level 0 of target.sharp: no pixel keeps a = 0 unless all have it. Its coarser levels are
  // averages of the finer ones if with_levels, undefined else.
  struct Fill {
    const ImageRect& rect;
    const ImageTarget& target;
    Holes holes = Holes::kHidden;
    bool with_levels = false;
  };
  void draw(const Fill& fill, FrameStats& stats) const;

 private:
  gpu::Program pull_, push_;
  gpu::VertexArray no_vertices_;
};

}  // namespace oriel
