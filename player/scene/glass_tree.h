// Triangles of a body of glass as rays find them in a shader: boxes within boxes, as rows of a texture.
#pragma once

#include <array>
#include <vector>

#include "formats/core/vec.h"

namespace oriel {

struct GlassTriangle {
  std::array<Vec3, 3> corners, normals;
};

// First the nodes, a box before those within it. Two texels each: its lower corner and the number of the node after all
// that it holds; its upper corner and -1, or of a leaf eight times the first of its triangles and how many they are.
// The root's number is how many nodes there are. Then six texels a triangle: its corners and the normals there. At most
// 2^20 triangles; texels without any: none.
std::vector<Vec4> glass_tree(std::vector<GlassTriangle> triangles);

// Of its texture: texel i is at (i % width, i / width).
inline constexpr int kGlassTreeWidth = 1024;

}  // namespace oriel
