// M: what a reflector sees, by marching each pixel's reflected ray through its radiance maps.
#pragma once

#include "player/gpu/program.h"
#include "player/reflections/image_target.h"
#include "player/scene/frame_options.h"
#include "player/scene/gpu_scene.h"

namespace oriel {

class MarchPass {
 public:
  static Result<MarchPass> create(gpu::Dialect dialect);

  // Clears the image and draws all of it that lies on the reflector's plane, beyond the reflector's edges too. The
  // reflector's front faces the eye. What no map sees keeps a = 0.
  // measure: instead of light, how many pixels of the image one of the map covers, across.
  void draw(GpuScene& scene, const GpuReflector& reflector, const View& view, const ImageRect& rect,
            const ImageTarget& target, const FrameOptions& options, FrameStats& stats, bool measure = false) const;

 private:
  void choose_maps(const GpuScene& scene, const ReflectorElement& element, const MapArray& array,
                   const Vec4& mirrored_eye, const FrameOptions& options, FrameStats& stats) const;
  gpu::Program program_;
  gpu::VertexArray no_vertices_;
};

}  // namespace oriel
