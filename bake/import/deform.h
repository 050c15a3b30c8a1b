// Morph targets and skins: meshes as they stand at rest, by the file's default weights and the places of its joints.
#pragma once

#include "bake/import/place.h"

namespace oriel {

// A mesh with its own shape in its place.
struct RestShape {
  gltf::LoadedMesh mesh;
  DMat4 world_from_mesh{1};
};

// The shape of a node's mesh, or none where it is the stored one: no weights and no skin. A skinned mesh stands where
// its joints are, whatever the transform of its own node. Error kInvalid for a joint that the skin does not have,
// or that is not in the scene.
Result<std::optional<RestShape>> rest_shape(const PosedNodes& nodes, const NodePose& pose, const gltf::LoadedMesh& mesh,
                                            gltf::AccessorReader& accessors);

}  // namespace oriel
