// Primitives as triangle lists in their mesh's own space.
#pragma once

#include "bake/import/accessors.h"
#include "bake/jobs/context.h"

namespace oriel::gltf {

// What a morph target adds, by vertex; empty: nothing.
struct MorphTarget {
  std::vector<Vec3> positions, normals;
};

// How much of a vertex a joint of the skin moves.
struct Influence {
  std::uint32_t joint = 0;
  float weight = 0;
};

// Only vertices that a triangle uses. All vertex arrays that are not empty have the length of positions.
struct TriangleMesh {
  std::string path;  // "meshes[0].primitives[1]"
  int material = -1;
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;          // as stored, not normalised; empty: none
  std::vector<Vec2> uv0, uv1;         // within ±1e9; empty: none
  std::vector<Vec4> tangents;         // as stored, with normals only; empty: none, or no normal map wants them
  std::vector<std::uint32_t> colors;  // RGBA8 linear, R lowest; empty: none
  std::vector<UVec3>
      triangles;  // counter-clockwise; without targets that a node gives a weight never degenerate, no exact duplicates
  std::vector<MorphTarget> targets;   // those that no node gives a weight are empty
  std::vector<Influence> influences;  // vertex by vertex, as many of each; empty: no skin
};

struct LoadedMesh {
  std::string name;
  std::vector<TriangleMesh> primitives;  // those with triangles left
};

// True where the triangle has no plane: corners that coincide or lie on a line, measured against its longest edge.
bool degenerate(const Vec3& a, const Vec3& b, const Vec3& c);

// Every mesh of the document. Strips and fans become lists; points and lines are left out with one warning, degenerate
// and doubled triangles with one a mesh. Error kInvalid for indices out of range, attributes of unequal count or of a
// type that glTF does not allow, and positions or weights that are not finite.
Result<std::vector<LoadedMesh>> load_meshes(const Document& document, const BufferStore& buffers,
                                            AccessorReader& accessors, Context& context);

}  // namespace oriel::gltf
