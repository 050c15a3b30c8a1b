// Diffuse light as vertex colours: the mesh is divided until interpolation between its vertices shows the lightmap.
#pragma once

#include <span>
#include <string>

#include "bake/run/assemble.h"
#include "bake/run/task.h"
#include "formats/assets/lightmap.h"
#include "formats/assets/mesh.h"
#include "formats/assets/vertex_light.h"

namespace oriel {

inline constexpr std::size_t kMostVertexTriangles = std::size_t{1} << 21;

struct VertexLightOptions {
  double error = 0.02;  // of a triangle: root mean square over its area, relative as --error is
  std::size_t most_triangles = kMostVertexTriangles;
};

struct VertexLightReport {
  double asked = 0;
  std::size_t triangles_before = 0, triangles = 0, vertices = 0;
  std::size_t coarse = 0;  // triangles that are off by more than what was asked: no larger than a texel, or too many
  double error = 0;        // root mean square over all surfaces with a lightmap
  bool full = false;       // most_triangles were not enough

  // What a user is to be told of that; empty where they were.
  std::string shortfall() const;
};

struct DividedMesh {
  VertexLight light;                 // of the mesh as it is now
  std::vector<std::uint32_t> first;  // by triangle of the mesh as it was its first one now, and the end of all
  VertexLightReport report;
};

// Vertices keep their numbers, new ones follow. A triangle that is off is cut in two at the middle of its longest edge;
// who else has that edge is cut there too, at its own longest edge first (Rivara 1984). So triangles on both sides of
// an edge, of one chart or of two, have the same corners on it: no cracks. Edges of a texel or less are not asked to be
// cut, and each cut leaves edges of at most √3/2 of the longest: it ends. What is off most, times its area, is cut
// first, until there would be more triangles than allowed.
DividedMesh divide_by_light(Mesh& mesh, std::span<const LightmapPage> pages, const VertexLightOptions& options);

// The same of the mesh that goes into the pack, by the pack's lightmap: what speaks of its triangles speaks of the
// divided ones then.
VertexLightReport light_pack_vertices(const BakeTask& bake, AssembledMesh& mesh, std::vector<Warning>& omissions);

}  // namespace oriel
