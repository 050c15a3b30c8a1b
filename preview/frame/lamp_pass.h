// The light of lamps on what pixels see: a pass over the frame for each point of a lamp, and its shadows before.
#pragma once

#include <span>

#include "formats/shadow/shadow_mesh.h"
#include "preview/frame/lamps.h"
#include "preview/frame/surface_pass.h"

namespace oriel {

// Where passes add up irradiance, lux. The depth and stencil are those of the surfaces that are lit.
struct PassLight {
  gpu::Texture2d light;
  gpu::Framebuffer framebuffer;
};
Result<PassLight> make_pass_light(const SeenSurfaces& surfaces);

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

class LampPass {
 public:
  static Result<LampPass> create(gpu::Dialect dialect);
  // Adds to the bound framebuffer, where the stencil is 0 (stencilled).
  void draw(const LampPoint& point, const PreviewMesh& mesh, const SeenSurfaces& surfaces, bool stencilled) const;

 private:
  gpu::Program program_;
  gpu::VertexArray no_vertices_;
};

}  // namespace oriel
