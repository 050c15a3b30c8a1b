// The graphics hardware's part of a frame: shadow volumes counted in the stencil, the light of a point on a lamp where
// none holds what a pixel sees, and that of elements without shadows.
#pragma once

#include <span>

#include "preview/frame/lamps.h"
#include "preview/frame/surface_pass.h"
#include "study/support/shadow_mesh.h"

namespace oriel::study {

// Counts in the stencil, modulo 256, the shadow volumes that hold what a pixel sees.
class VolumePass {
 public:
  static Result<VolumePass> create(gpu::Dialect dialect);
  void take(const ShadowMesh& mesh);
  // Into the stencil of the bound framebuffer, whose depth is that of the surfaces. light: as the volumes' own.
  void draw(const ShadowVolumes& volumes, const Vec4& light, const View& view) const;

 private:
  gpu::Program program_;
  gpu::VertexArray vertices_;
  std::vector<gpu::Buffer> buffers_;
};

// Over the whole frame.
class LampPass {
 public:
  static Result<LampPass> create(gpu::Dialect dialect);
  // Adds irradiance, lux, to the bound framebuffer, where the stencil is 0. No measured lamps.
  void draw(const LampPoint& point, const Scene& scene, const SeenSurfaces& surfaces) const;
  // Adds what elements reflect. At most 64.
  void draw_elements(std::span<const LampPoint> elements, const SeenSurfaces& surfaces) const;
  static constexpr std::size_t kMostElements = 64;

 private:
  gpu::Program lamp_, elements_;
  gpu::VertexArray no_vertices_;
};

}  // namespace oriel::study
