// Double-sided surfaces as one-sided ones, which lightmaps, paths and the player treat alike.
#pragma once

#include <span>

#include "bake/scene/scene.h"

namespace oriel {

// Which sides of a double-sided triangle receive light.
enum class LitSides : std::uint8_t { kFront, kBack, kBoth };

// sides: by triangle; kFront for those of one-sided surfaces. Splits each surface by them:
// kFront: stays as it is.
// kBack: is turned over, so that its front is the lit side.
// kBoth: becomes a one-sided surface and, behind all other surfaces, its back (Scene::twin) with charts of its own.
// A surface's triangles and vertices may come in another order. Materials are copied where the parts of a surface need
// different ones. What a normal map tilts is the same before and after.
Scene split_sides(Scene scene, std::span<const LitSides> sides);

}  // namespace oriel
