// Nodes and meshes into the one flat list of triangles that a Scene is.
#pragma once

#include <span>

#include "bake/import/meshes.h"

namespace oriel {

struct NodePose {
  std::uint32_t node = 0;
  DMat4 world_from_node{1};
};

// Every node under the roots, parents before children, in the document's order. Error kInvalid where a transform
// overflows.
Result<std::vector<NodePose>> pose_nodes(const gltf::Document& document, std::span<const std::uint32_t> roots);

// Fills origin, bounds, vertices, triangles and surfaces of `scene`; scene.materials gains glTF's default material
// where a primitive has none. World positions are computed in double and stored relative to the centre of their bounds;
// a mirrored node's winding is flipped; triangles that are degenerate after rounding are dropped. Normals that are
// missing or not on the front of their triangle are replaced by the triangle's own. mover_of_node: Surface::mover, by
// node. Error kInvalid: no triangle, or a scene too large or small for floats (beyond 1e9 m or below 1e-9 m).
Status place_meshes(const gltf::Document& document, std::span<const gltf::LoadedMesh> meshes,
                    std::span<const NodePose> poses, std::span<const std::int32_t> mover_of_node,
                    gltf::AccessorReader& accessors, gltf::MemoryBudget& budget, Scene& scene, Context& context);

}  // namespace oriel
