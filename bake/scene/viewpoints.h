// Cameras, walks of animated cameras, and punctual lights, placed in scene space.
#pragma once

#include "bake/scene/place.h"

namespace oriel {

// Fills scene.cameras, scene.paths and scene.lights; scene.origin is known already. A camera or light whose place or
// direction is not finite or has no length is left out with a warning. A camera moved by an animation, by itself or
// with a node above it, gives a path named as its node: keys of all its channels, and more between where it turns fast
// or an ancestor's turn bends its way. What else an animation moves stands still, with one warning. Error kInvalid for
// channels whose accessors do not fit.
Status place_viewpoints(const gltf::Document& document, std::span<const NodePose> poses,
                        gltf::AccessorReader& accessors, Scene& scene, Context& context);

}  // namespace oriel
