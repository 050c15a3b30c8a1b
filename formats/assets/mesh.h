// The static geometry that the player draws, already placed in the world.
#pragma once

#include <string>
#include <vector>

#include "formats/core/vec.h"

namespace oriel {

// A run of triangles of one glTF primitive in one node: one material, one lightmap page.
struct MeshPart {
  std::string name;                 // node name, or the mesh's where the node has none; need not be unique
  std::uint32_t first_index = 0;    // into Mesh::indices; a multiple of 3
  std::uint32_t index_count = 0;    // a multiple of 3
  std::uint32_t material = 0;       // into Pack::materials
  std::int32_t lightmap_page = -1;  // into Pack::lightmaps, -1: no light was baked for it (unlit)
};

// Vertices are split where charts or normals part. All vertex arrays have the same length, except that colors (all
// white) and what serves normal maps may be empty.
struct Mesh {
  DVec3 origin{0};                    // world position of (0,0,0) below, metres; keeps floats small far from the origin
  std::vector<Vec3> positions;        // metres, relative to origin
  std::vector<Vec3> normals;          // unit, shading normals
  std::vector<Vec2> uvs;              // base colour texture coordinates, texture transform applied, v down as glTF
  std::vector<Vec2> lightmap_uvs;     // [0,1], v = 0 is the first texel row of the page
  std::vector<std::uint32_t> colors;  // RGBA8 linear vertex colours, R in the lowest byte
  // Normal maps: both empty where no material has one.
  std::vector<Vec2> normal_uvs;  // as uvs
  std::vector<Vec4> tangents;  // unit xyz, w = ±1: bitangent = w · cross(normal, xyz); w = 0: follows from normal_uvs
  std::vector<std::uint32_t> indices;
  std::vector<MeshPart> parts;
};

}  // namespace oriel
