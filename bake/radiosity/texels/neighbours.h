// Adjacency of texels on a surface in the world: across charts and objects, never through walls.
#pragma once

#include "bake/radiosity/texels/texels.h"

namespace oriel {

inline constexpr int kMaxNeighbours = 8;

struct TexelGraph {
  std::vector<std::array<std::uint32_t, kMaxNeighbours>> neighbour;  // by texel; symmetric
  std::vector<std::uint8_t> count;

  std::span<const std::uint32_t> of(std::size_t i) const { return {neighbour[i].data(), count[i]}; }
};

// Two texels are neighbours if they lie within about 1.6 texels of each other, if their normals agree within about 25°,
// if each lies in the other's plane, and if a segment just above the surface joins them: a thin wall between them
// separates them. At chart edges the graph goes on across seams. Error kStopped.
Result<TexelGraph> find_neighbours(const Transport& transport, const Texels& texels, const Stage& stage);

// The same graph with the adjacent texels of each chart added, whatever their normals, while a texel has fewer than
// kMaxNeighbours. An example are the flutes of a column: their light differs, but not who sees them, nor the effort to
// light them.
TexelGraph with_chart_neighbours(TexelGraph graph, const Texels& texels);

}  // namespace oriel
