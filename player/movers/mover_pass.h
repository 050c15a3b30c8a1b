// Movers where they stand, in the light that they meet there.
#pragma once

#include <array>

#include "player/gpu/program.h"
#include "player/movers/mover_light.h"
#include "player/scene/frame_context.h"

namespace oriel {

// One of Pack::movers, for a frame.
struct PlacedMover {
  const GpuMover* mover = nullptr;
  Mat4 pack_from_object{1};
  Vec4 sphere{0};  // around it: centre in pack space, radius
  MoverLight light;
  gpu::Texture2d table;  // of light
  bool normal_mapped = false;
  int components = 0;
};
// Of the box around it, pack space.
std::array<Vec3, 8> corners_of(const PlacedMover& placed);
// At the poses of the options. Light is looked up anew.
std::vector<PlacedMover> place_movers(const GpuScene& scene, const FrameOptions& options);

// scene.bounds() with the movers at those poses (empty: at rest).
Bounds bounds_with_movers(const GpuScene& scene, std::span<const MoverPose> poses);

// What a pass draws with: the pack's view as seen by that mover.
inline Mat4 clip_from_object(const View& view, const PlacedMover& placed) {
  return view.clip_from_pack * placed.pack_from_object;
}

inline constexpr int kMaxShadowMovers = 16;  // of one light: others get its light without shadows and cast none

// In the stencil, where a mover is seen.
inline constexpr GLuint kMoverBits = 0x7f;

// What bright lights add to movers, lux by pixel of the view, and where: shaders/lib/lit_surface.glsl.
struct MoverChange {
  const gpu::Texture2d* light = nullptr;
  const gpu::Texture2d* surfaces = nullptr;
};

class MoverPass {
 public:
  static Result<MoverPass> create(gpu::Dialect dialect);

  // Depth into the bound framebuffer.
  void draw_depth(const FrameContext& context, std::span<const PlacedMover> movers) const;
  // Light, over that depth. weights: of the diffuse part, the undirected reflection, the emission. change: may be
  // null.
  void draw(const FrameContext& context, std::span<const PlacedMover> movers, const Vec3& weights,
            const MoverChange* change) const;
  // The same into the image of a mirror, without change; alpha tells the distance.
  void draw_reflected(const FrameContext& context, std::span<const PlacedMover> movers) const;

 private:
  void draw_light(const FrameContext& context, std::span<const PlacedMover> movers, const Vec3& weights) const;
  gpu::Program depth_, light_;
};

}  // namespace oriel
