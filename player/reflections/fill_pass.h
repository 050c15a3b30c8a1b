// Holes of the reflected image: pulled to coarser levels from what is there, pushed back to where nothing is.
#pragma once

#include "player/gpu/program.h"
#include "player/reflections/image_target.h"
#include "player/scene/frame_options.h"

namespace oriel {

class FillPass {
 public:
  static Result<FillPass> create(gpu::Dialect dialect);
  // Fills target.filled from level 0 of target.sharp: no pixel keeps a = 0 unless all have it. What a mirror shows of a
  // hole is something that nearer things hid, so what lies behind flows into it from far around. In an image that blurs
  // most holes lie beside the reflector, and show what it does next to them; of that its coarser levels too are made.
  struct Fill {
    const ImageRect& rect;
    const ImageTarget& target;
    bool blurs = false;
  };
  void draw(const Fill& fill, FrameStats& stats) const;

 private:
  gpu::Program pull_, push_;
  gpu::VertexArray no_vertices_;
};

}  // namespace oriel
