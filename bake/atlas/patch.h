// A set of a surface's triangles with their connections, apart from the surface: what one chart is made of.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bake/atlas/polygon.h"

namespace oriel {

inline constexpr std::uint32_t kNoEdge = ~0u;

// Edge 3 * i + k goes from corner k of triangle i to the next corner. Across it lies that edge of another triangle of
// the patch, or none.
struct Patch {
  std::vector<std::uint32_t> faces;   // of the surface
  std::vector<std::uint32_t> across;  // 3 * faces.size() edges or kNoEdge

  std::size_t size() const { return faces.size(); }
};

inline std::uint32_t next_edge(std::uint32_t edge) {
  return edge % 3 == 2 ? edge - 2 : edge + 1;
}

// Faces of a surface whose edges are joined by `across`. slot (by face of the surface) is scratch: only its entries
// of these faces are touched. member(face) tells whether a face is one of them.
template <class Member>
Patch make_patch(std::vector<std::uint32_t> faces, std::span<const std::uint32_t> across,
                 std::vector<std::uint32_t>& slot, const Member& member) {
  Patch patch;
  patch.across.assign(3 * faces.size(), kNoEdge);
  for (std::uint32_t i = 0; i < faces.size(); ++i) slot[faces[i]] = i;
  for (std::uint32_t i = 0; i < faces.size(); ++i) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t other = across[3 * std::size_t{faces[i]} + k];
      if (other != kNoEdge && member(other / 3)) patch.across[3 * i + k] = 3 * slot[other / 3] + other % 3;
    }
  }
  patch.faces = std::move(faces);
  return patch;
}

// The connected pieces of the part of a patch whose triangles have each label. label.size() == patch.size().
std::vector<Patch> pieces_by_label(const Patch& patch, std::span<const std::uint32_t> label);

// Corners that are one vertex of the patch: by corner (3 * i + k) its vertex, numbered in order of first use. Every
// vertex has one fan of triangles; where two fans touch there are two vertices.
struct PatchVertices {
  std::vector<std::uint32_t> of_corner;
  std::uint32_t count = 0;
};
PatchVertices number_vertices(const Patch& patch);

// The closed outlines of a patch laid flat.
std::vector<OutlineEdge> outline(const Patch& patch, std::span<const Triangle2> points);

}  // namespace oriel
