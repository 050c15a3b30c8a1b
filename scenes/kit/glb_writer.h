// A sample scene as a binary glTF 2.0 file.
#pragma once

#include "formats/core/result.h"
#include "scenes/kit/scene_builder.h"

namespace oriel::sample {

// The bytes of a .glb: the same for the same scene. Meshes become one primitive each; cameras and paths nodes of their
// own, a path an animation of its node. Errors: kInvalid for a scene that is not consistent (an index out of range, a
// textured material on a mesh without uvs, a number that is not finite), or beyond the 4 GiB of the format.
Result<Bytes> write_glb(const SampleScene& scene);

}  // namespace oriel::sample
