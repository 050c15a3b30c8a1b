// Connectivity of a surface: which triangle lies across each edge.
#pragma once

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "bake/atlas/patch.h"
#include "bake/scene/scene.h"

namespace oriel {

// Positions and connectivity. Face i is the surface's i-th triangle.
struct SurfaceMeshTraits : OpenMesh::DefaultTraits {
  VertexAttributes(OpenMesh::Attributes::None);
  HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge);
  EdgeAttributes(OpenMesh::Attributes::None);
  FaceAttributes(OpenMesh::Attributes::None);
};
using SurfaceMesh = OpenMesh::TriMesh_ArrayKernelT<SurfaceMeshTraits>;

// Vertices at the same position become one, so that triangles split only by their normals or texture coordinates are
// neighbours. Any triangle soup gives a manifold: triangles of consistent winding are joined two by two at an edge,
// those with the most alike normals first, and never where the surface folds back onto itself, so that the front and
// back of a modelled sheet come apart; a vertex where several fans touch is split. A triangle with two corners in one
// place has no neighbours.
SurfaceMesh build_surface_mesh(const Scene& scene, const Surface& surface);

// By edge 3 * face + k (from corner k to the next): the edge across it, or kNoEdge. What is left of the mesh once its
// connections are known, in a fifth of the memory.
std::vector<std::uint32_t> edges_across(const SurfaceMesh& mesh);

// The unit normal (front side) and area of a triangle in double; the zero vector where it has no area.
struct TriangleFrame {
  DVec3 normal{0};
  double area = 0;
};
TriangleFrame triangle_frame(const Scene& scene, std::uint32_t triangle);

}  // namespace oriel
