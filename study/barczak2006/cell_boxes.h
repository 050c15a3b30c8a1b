// Draws boxes around cells of space in the light that movers take there, in passes of a few lights each (Barczak 2006,
// section 4.3.2).
#pragma once

#include "player/movers/shade_draw.h"
#include "study/barczak2006/light_passes.h"

namespace oriel::study {

class CellBoxes {
 public:
  static Result<CellBoxes> create(gpu::Dialect dialect);

  Status set_scene(const ShadeScene& scene);
  // What draw() draws from now on. The cell after the scene's last is all of space.
  Status set_passes(std::vector<LightPass> passes, std::size_t lights_a_pass);
  // Adds lux to the framebuffer that is bound, a picture of so many pixels. lights: has lights and movers.
  void draw(const View& view, const ShadeDraw& lights, const ShadeMaps& maps, const LitPixels& pixels,
            FrameStats& stats) const;

 private:
  gpu::Program program_;
  gpu::VertexArray no_vertices_;
  gpu::Texture2d cells_, list_;
  std::vector<LightPass> passes_;
  std::size_t lights_a_pass_ = 1;
};

}  // namespace oriel::study
