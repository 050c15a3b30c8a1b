// Meshes of fewer triangles, where all would take too long.
#pragma once

#include "bake/import/meshes.h"

namespace oriel {

// The mesh with at most that share of its triangles: vertices of one cell of a grid become one of them (Rossignac and
// Borrel 1993, "Multi-resolution 3D approximations", by meshoptimizer). What a vertex has beside its place stays.
// Primitives of which nothing would be left stay whole.
gltf::LoadedMesh simplified(const gltf::LoadedMesh& mesh, double share);

}  // namespace oriel
