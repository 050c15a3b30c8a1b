// Nodes and meshes into the one flat list of triangles that a Scene is.
#pragma once

#include <span>

#include "bake/import/meshes.h"

namespace oriel {

struct NodePose {
  std::uint32_t node = 0;
  DMat4 world_from_node{1};
};

// By node of the document: the mover that its mesh belongs to, an index into `nodes`; -1: it stands still.
struct MoverNodes {
  std::vector<std::uint32_t> nodes;
  std::vector<std::int32_t> of_node;
};

struct PosedNodes {
  const gltf::Document& document;
  std::vector<NodePose> poses;             // parents before children, in the document's order
  MoverNodes movers = {};                  // find_movers()
  std::vector<std::int32_t> pose_of = {};  // by node of the document: its pose; -1: it is not in the scene
};

// Every node under the roots. Error kInvalid where a transform overflows.
Result<PosedNodes> pose_nodes(const gltf::Document& document, std::span<const std::uint32_t> roots);

struct PlacedScene {
  Scene& scene;
  Context& context;
};

// Fills origin, bounds, vertices, triangles and surfaces of `scene`; scene.materials gains glTF's default material
// where a primitive has none. World positions are computed in double and stored relative to the centre of their bounds;
// a mirrored node's winding is flipped; triangles that are degenerate after rounding are dropped. Normals that are
// missing or not on the front of their triangle are replaced by the triangle's own. Error kInvalid: no triangle, or a
// scene too large or small for floats (beyond 1e9 m or below 1e-9 m).
//
// most_triangles: 0 for no limit. Of more, meshes that stand in several places are simplified, with a warning; error
// kInvalid where that is not nearly enough.
Status place_meshes(const PosedNodes& nodes, std::span<const gltf::LoadedMesh> meshes, gltf::AccessorReader& accessors,
                    std::uint64_t most_triangles, PlacedScene placed);

}  // namespace oriel
