// Light by pixel where it is dear to find: at one of sixteen pixels, between them where surfaces are even, at all of
// them elsewhere. After Barczak 2006 ("Realistic Rendering of Large Sets of Point Lights", 4.3.3).
#pragma once

#include <functional>

#include "player/gpu/framebuffer.h"
#include "player/gpu/program.h"

namespace oriel {

// Where light goes: lux, added to `light`.
struct LitTarget {
  const gpu::Texture2d& surfaces;  // shaders/lib/lit_surface.glsl
  const gpu::Texture2d& light;
  const gpu::Framebuffer& framebuffer;  // of light alone
  std::uint64_t serial = 0;             // another one for other textures, above 0
};

// Pixels that are asked for their light.
struct LitPixels {
  const gpu::Texture2d& surfaces;
  const gpu::Texture2d* mask = nullptr;  // 0 where nothing is wanted; may be null
};

class FewPixels {
 public:
  static constexpr int kStep = 4;  // of the target's pixels one is drawn along each side
  static Result<FewPixels> create(gpu::Dialect dialect);

  // draw_light: adds lux to the framebuffer that is bound; called for the few, then for what is left. Error kRuntime.
  Status draw(const LitTarget& target, const std::function<void(const LitPixels&)>& draw_light);

 private:
  Status make_pictures(const LitTarget& target);

  gpu::Program fewer_, between_;
  gpu::VertexArray no_vertices_;
  gpu::Texture2d surfaces_, light_, mask_;
  gpu::Framebuffer surfaces_target_, light_target_, between_target_;
  std::uint64_t of_ = 0;  // LitTarget::serial
};

}  // namespace oriel
