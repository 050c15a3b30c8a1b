// Which bright lights shine on which movers, and whose shadows are worth drawing. No OpenGL.
#pragma once

#include "player/movers/light_samples.h"
#include "player/movers/mover_pass.h"
#include "player/movers/shadow_shaft.h"

namespace oriel {

// A light and whom it shines on, as far as they or their shadows are in view.
struct LitMovers {
  struct Receiver {
    const PlacedMover* mover = nullptr;
    std::uint32_t index = 0;  // among the movers of the frame
    Vec4 share{0};            // LinearShare::fit
    bool visible = false;
  };
  struct Caster {
    const PlacedMover* mover = nullptr;
    std::uint32_t index = 0;
    ShadowBox box;
    bool on_scene = false;               // its shadow is in view, and no faint one
    ShadowBox scene_box{};               // where in `box` it is looked for on the scene
    std::vector<std::size_t> on_movers;  // receivers in view that it may fall on, itself among them
  };
  std::uint32_t light = 0;
  LightSamples samples;
  std::vector<Receiver> receivers;  // nearest first
  std::vector<Caster> casters;      // at most kMaxShadowMovers
};

// By light. bounds: of the scene.
std::vector<LitMovers> find_lit(std::span<const BrightLight> lights, std::span<const PlacedMover> movers,
                                const Frustum& frustum, const Bounds& bounds, const FrameOptions& options);

}  // namespace oriel
