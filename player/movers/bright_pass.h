// Bright lights on movers, with their shadows; and the shadows of movers on the scene around.
//
// Each mover that a bright light shines on has two shadow maps from each of a few points of that light (LightSamples):
// of the mover itself, and of the scene that stands still, both as wide as the mover is from there. On a mover the
// light's points count where neither the scene nor a mover is nearer. The scene's lightmap holds the light as if there
// were no movers: what they block of points that nothing else blocks is to be taken from it.
#pragma once

#include "player/gpu/framebuffer.h"
#include "player/movers/light_samples.h"
#include "player/movers/mover_pass.h"

namespace oriel {

inline constexpr int kMaxShadowMovers = 16;  // of one light: others get its light without shadows and cast none

class BrightPass {
 public:
  static Result<BrightPass> create(gpu::Dialect dialect);

  // Into a picture of the view's size: lux by pixel that bright lights add on movers, or that movers take from the
  // scene. depth: of the frame, the movers included. Its own framebuffer stays bound. Error kRuntime.
  Status draw(const GpuScene& scene, const View& view, std::span<const PlacedMover> movers, const FrameOptions& options,
              const gpu::Texture& depth, FrameStats& stats);
  // Of the last draw.
  const gpu::Texture& change() const { return change_; }

 private:
  Status ensure_targets(int width, int height, const gpu::Texture& depth, int layers);
  void draw_maps(const GpuScene& scene, const LightSamples& light, std::span<const PlacedMover* const> casters,
                 FrameStats& stats) const;
  void draw_depth(const GpuScene& scene, const std::vector<DrawRange>& ranges, const Mat4& clip_from_pack,
                  FrameStats& stats) const;
  void set_light(const LightSamples& light, std::span<const PlacedMover* const> casters, float reach) const;
  void draw_receiver(const GpuScene& scene, const std::vector<DrawRange>& ranges, const Frustum* frustum,
                     FrameStats& stats) const;

  gpu::Program depth_, light_;
  gpu::Texture change_;
  GLuint depth_of_frame_ = 0;
  gpu::Framebuffer framebuffer_, layers_target_;
  gpu::TextureArray mover_depth_, scene_depth_;
  int layers_ = 0;
};

}  // namespace oriel
