// Meshes of fewer triangles, where all would take too long.
#pragma once

#include "bake/import/meshes.h"

namespace oriel {

// The mesh with at most that share of its triangles, but a few a primitive: vertices of one cell of a grid become its
// first (Rossignac and Borrel 1993, "Multi-resolution 3D approximations"). What a vertex has beside its place stays.
gltf::LoadedMesh simplified(const gltf::LoadedMesh& mesh, double share);

}  // namespace oriel
