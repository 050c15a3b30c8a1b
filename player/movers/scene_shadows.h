// Shadows of movers on the scene that are drawn otherwise than by shadow maps.
#pragma once

#include <optional>

#include "player/movers/lit_movers.h"

namespace oriel {

class SceneShadows {
 public:
  virtual ~SceneShadows() = default;
  // Before the maps of a frame. Casters whose shadows these all draw are to cast none on the scene by maps (on_scene).
  virtual void prepare(const FrameContext& context, std::span<LitMovers> lights) = 0;
  // Into the bound picture, what movers take of all lights, lux; or, of one light, zeros where maps are to take
  // nothing. surfaces: what is seen of the scene, shaders/lib/lit_surface.glsl.
  virtual void draw(const FrameContext& context, const gpu::Texture2d& surfaces,
                    std::optional<std::uint32_t> zeros_of) const = 0;
};

}  // namespace oriel
