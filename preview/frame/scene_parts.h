// What of a scene that was read again is as it was.
#pragma once

#include "bake/scene/scene.h"
#include "formats/core/hash.h"

namespace oriel {

// Hashes of what a scene is made of. Where one is as before, what was made from it is kept.
struct SceneParts {
  Hash128 shape;     // triangles, and which of them let light pass: rays
  Hash128 vertices;  // those, and what vertices bear: the device's buffers
  Hash128 images;    // textures
  Hash128 sky;       // its image: a texture
};
SceneParts parts_of(const Scene& scene);

}  // namespace oriel
