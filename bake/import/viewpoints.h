// Cameras, walks of animated cameras, and punctual lights, placed in scene space.
#pragma once

#include "bake/import/place.h"
#include "bake/import/tracks.h"

namespace oriel {

// Fills scene.cameras, scene.paths and scene.lights; scene.origin is known already. A camera or light whose place or
// direction is not finite or has no length is left out with a warning. A camera moved by an animation, by itself or
// with a node above it, gives a path named as its node, with the keys of motion_of() and its errors.
Status place_viewpoints(const PosedNodes& nodes, std::span<const Animation> animations, Scene& scene, Context& context);

}  // namespace oriel
