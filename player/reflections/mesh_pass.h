// M: what a reflector sees, by drawing the meshes of its radiance maps.
#pragma once

#include "player/gpu/program.h"
#include "player/gpu/raster_state.h"
#include "player/reflections/image_target.h"
#include "player/scene/frame_context.h"

namespace oriel {

class MeshPass {
 public:
  static Result<MeshPass> create(const gpu::Device& device);

  // Clears the image and draws the maps of all elements that it shows: those that suit the eye best, and where they
  // leave holes the others behind them. `only`: of a mirror, the pixels that show it. Holes keep a = 0.
  void draw(const FrameContext& context, const ReflectedImage& image, const ShownPixels* only) const;

 private:
  // Of an element, those that suit the eye best first.
  struct Chosen {
    std::size_t element = 0;
    std::vector<std::uint32_t> maps;  // into ReflectorElement::maps
  };
  void count_holes(gpu::RasterState state) const;
  void draw_element(const FrameContext& context, const GpuReflector& reflector, const Chosen& chosen, bool first) const;
  gpu::Program program_, holes_;
  gpu::VertexArray no_vertices_;
  gpu::Query query_;
  bool conditional_ = false;  // whether the device can leave out a draw by the count of a query
};

}  // namespace oriel
