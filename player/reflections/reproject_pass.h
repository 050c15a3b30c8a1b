// M: the mirrored world from a reflector's radiance maps, as points in quadtrees (Bastos et al. 1999, section 8.1.3).
#pragma once

#include "player/gpu/program.h"
#include "player/reflections/image_target.h"
#include "player/scene/frame_context.h"

namespace oriel {

class ReprojectPass {
 public:
  static Result<ReprojectPass> create(const gpu::Device& device);

  // Clears the image and draws the chosen maps of all elements that it shows. The reflector's front faces the eye.
  // Holes keep a = 0.
  Status draw(const FrameContext& context, const ReflectedImage& image) const;

 private:
  Status draw_map(const FrameContext& context, const SplatView& view, std::uint32_t map) const;
  gpu::Program program_;
  gpu::VertexArray instances_;
  float point_max_ = 1;
};

}  // namespace oriel
