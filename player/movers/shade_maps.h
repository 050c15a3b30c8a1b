// Depth of movers and of what stands still around lights that stand for all light from everywhere, on the device.
#pragma once

#include "player/gpu/framebuffer.h"
#include "player/movers/mover_pass.h"
#include "player/movers/shade_scene.h"

namespace oriel {

class ShadeMaps {
 public:
  static Result<ShadeMaps> create(gpu::Dialect dialect);

  // Maps of the movers of `side`² texels a light, fewer where all of them would be more than 256 MB; all of them are to
  // be drawn anew. movers: the pack's, always the same. Error kRuntime.
  Status begin(const ShadeScene& scene, std::span<const Mover> movers, int side);
  // Draws maps of lights in the lists in which movers are not where they are drawn, at most maps_a_frame: the brightest
  // times the calls that it is late first, so that none waits for ever (Barczak 2006, section 4.5.3). intensities: by
  // light. How many are left. Its own framebuffer stays bound.
  std::size_t refresh(const FrameContext& context, std::span<const CellLights> wanted,
                      std::span<const Vec3> intensities, std::span<const PlacedMover> movers);

  const gpu::TextureArray& movers() const { return movers_; }
  const gpu::TextureArray& still() const { return still_; }
  int wanted_side() const { return wanted_side_; }  // that begin() was asked for

 private:
  struct Known {
    std::vector<Mat4> poses;  // of all movers when it was drawn; empty: never
    std::uint32_t late = 0;   // calls since it was wanted
  };
  struct Face {
    Mat4 clip_from_object, light_from_object;
    Vec2 signs;
  };
  void draw_face(const GpuScene& scene, const GpuMover& shape, const Face& face, FrameStats& stats) const;
  void draw(const GpuScene& scene, std::uint32_t light, std::span<const PlacedMover> movers, FrameStats& stats) const;

  gpu::Program depth_, plain_depth_;
  gpu::Framebuffer target_;
  gpu::TextureArray movers_, still_;
  std::vector<HemisphereMap> maps_;
  std::vector<Known> known_;                     // by light
  std::vector<std::optional<GpuMover>> shapes_;  // by mover; nothing: as it is
  int side_ = 0, wanted_side_ = 0;
};

}  // namespace oriel
