// Shadow maps of movers, kept as long as they hold.
//
// A layer belongs to a mover and up to four points of a bright light. There are two arrays of them: the mover alone,
// and the scene that stands still, as far as the mover's shadow can fall (Shaft). Maps of the scene are drawn again
// where the mover's sphere has moved, maps of the mover where it has moved or turned.
#pragma once

#include <map>

#include "player/gpu/framebuffer.h"
#include "player/movers/light_samples.h"
#include "player/movers/mover_pass.h"

namespace oriel {

inline constexpr int kPointsOfLayer = 4;  // vec4 and mat4[4] of shaders/passes/mover_shadow.frag

class ShadowMaps {
 public:
  static Result<ShadowMaps> create(gpu::Dialect dialect);

  struct Request {
    const PlacedMover* mover = nullptr;
    std::span<const Vec4> points;                   // LightSamples::at, one to kPointsOfLayer
    std::uint32_t light = 0, index = 0, group = 0;  // of the pack; of the mover; of these among the light's points
  };
  // The layers of at most kMaxShadowMovers movers and all points of a light, drawn where they are not known. They hold
  // until the next call. Its own framebuffer stays bound where it drew. Error kRuntime.
  Result<std::vector<int>> layers(const GpuScene& scene, std::span<const Request> requests, FrameStats& stats);

  const gpu::TextureArray& movers() const { return mover_depth_; }
  const gpu::TextureArray& scene() const { return scene_depth_; }

 private:
  struct Known {
    int layer = 0;
    Mat4 pose{1};
    Vec4 sphere{0};
    std::vector<Vec4> points;
    std::uint64_t used = 0;  // by which call
  };
  using Key = std::array<std::uint32_t, 3>;  // light, mover, group

  Status ensure_layers();
  int free_layer();
  void draw(const GpuScene& scene, const Request& request, int layer, bool of_scene, FrameStats& stats);
  void draw_ranges(const GpuScene& scene, const std::vector<DrawRange>& ranges, const Mat4& clip_from_pack,
                   FrameStats& stats) const;

  gpu::Program depth_, plain_depth_;
  gpu::Framebuffer target_;
  gpu::TextureArray mover_depth_, scene_depth_;
  std::map<Key, Known> known_;
  std::vector<int> free_;
  std::uint64_t scene_serial_ = 0, calls_ = 0;
};

}  // namespace oriel
