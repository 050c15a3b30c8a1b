// By what rays find their way out of glass: the surface of curved bodies around their middles, or the triangles of
// hollow and branched ones; and the scene around as they see it beyond the frame. Each is made once.
#pragma once

#include "player/passes/scene_pass.h"

namespace oriel {

inline constexpr int kAroundSize = 256;  // texels a side of a face

class GlassCubes {
 public:
  Status compile(gpu::Dialect dialect);
  // Another scene has other bodies; the same one with other lights has the same shapes.
  void start(const GpuScene& scene);
  // Of one of GpuScene::glass() that covers that share of the picture, what it needs and does not have yet. Leaves a
  // framebuffer of its own bound. Errors of the driver.
  Status make(const FrameContext& context, const ScenePass& scene_pass, std::size_t body, float share);
  const gpu::CubeTexture& shape(std::size_t body) const { return bodies_[body].shape; }
  const gpu::Texture2d& tree(std::size_t body) const { return bodies_[body].tree; }
  const gpu::CubeTexture& around(std::size_t body) const { return bodies_[body].around; }
  // The body whose surroundings stand for this one's.
  std::size_t nearest_around(const GpuScene& scene, std::size_t body) const;
  std::uint64_t bytes() const;

 private:
  struct Cubes {
    gpu::CubeTexture shape;
    gpu::Texture2d tree;
    gpu::CubeTexture around;  // as seen from its centre
    std::uint64_t around_of = 0;
    bool whole = false;  // all images were there
  };
  Status draw_shape(const FrameContext& context, std::size_t body);
  Status draw_around(const FrameContext& context, std::size_t body, const ScenePass& scene_pass);

  gpu::Program shape_;
  std::vector<Cubes> bodies_;  // by GpuScene::glass()
  std::uint64_t geometry_of_ = 0;
  gpu::Texture2d depth_;  // of a face
  gpu::Framebuffer face_;
};

}  // namespace oriel
