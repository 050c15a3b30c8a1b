// Conversion of double-sided surfaces to one-sided ones, which lightmaps, paths and the player treat alike.
#pragma once

#include <span>

#include "bake/scene/scene.h"

namespace oriel {

// The sides of a double-sided triangle that receive light.
enum class LitSides : std::uint8_t { kFront, kBack, kBoth };

// Splits each surface by the lit sides of its triangles. sides: by triangle; kFront for those of one-sided surfaces.
// kFront: stays as it is.
// kBack: is flipped, so that its front is the lit side.
// kBoth: becomes a one-sided surface and, after all other surfaces, its back (Scene::twin) with charts of its own.
// The order of a surface's triangles and vertices may change. Materials are copied where the parts of a surface need
// different ones. Normal maps keep their effect.
Scene split_sides(Scene scene, std::span<const LitSides> sides);

}  // namespace oriel
