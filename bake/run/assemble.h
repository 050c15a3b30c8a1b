// The scene as a pack holds it.
#pragma once

#include <span>

#include "bake/atlas/atlas.h"
#include "bake/material/materials.h"
#include "formats/pack/pack.h"

namespace oriel {

struct AssembledMesh {
  Mesh mesh;
  std::vector<std::uint32_t> scene_vertex;  // by mesh vertex: into the scene's vertex arrays
  std::vector<std::uint32_t> first_index;   // by scene triangle: its entries in mesh.indices start here
};

// A scene's triangles in mesh.indices.
std::vector<std::uint32_t> mesh_indices(const AssembledMesh& mesh, std::span<const std::uint32_t> triangles);

// Vertices are split where lightmap coordinates part; parts are runs of one surface on one page, in the scene's order.
AssembledMesh assemble_mesh(const Scene& scene, const Atlas& atlas);

// Pack materials with indices into `maps` (K, R), and the base colour and normal textures that they use.
void assemble_materials(const Scene& scene, const MaterialMaps& maps, Pack& pack);

// These, the mesh, cameras and paths, and what the sky shows.
void assemble_scene(const Scene& scene, MaterialMaps maps, AssembledMesh mesh, Pack& pack);

// Leaves out of a pack what validate() finds an error in, and what depends on it; appends one line for each with the
// first reason (sound_pack.cpp). Error kRuntime where the scene, its materials or the lightmap itself fail: no pack is
// left then.
Status leave_out_unsound(Pack& pack, std::vector<std::string>& left_out);

}  // namespace oriel
