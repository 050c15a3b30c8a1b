// Which texels lie side by side on the same surface, in the world: across charts and objects, never through walls.
#pragma once

#include "bake/radiosity/texels/texels.h"

namespace oriel {

inline constexpr int kMaxNeighbours = 8;

struct TexelGraph {
  std::vector<std::array<std::uint32_t, kMaxNeighbours>> neighbour;  // by texel; symmetric
  std::vector<std::uint8_t> count;

  std::span<const std::uint32_t> of(std::size_t i) const { return {neighbour[i].data(), count[i]}; }
};

// Neighbours lie within about one and a half texels of each other, look the same way (within about 25°), lie in each
// other's plane, and see each other just above the surface: a thin wall standing between them parts them. Charts' edges
// are joined to what continues the surface. Error kStopped.
Result<TexelGraph> find_neighbours(const Transport& transport, const Texels& texels, const Stage& stage);

// And those that lie beside a texel on its chart, whichever way they look, where it has places left: the flutes of a
// column, whose light differs, though not who sees them and what it takes to light them.
TexelGraph with_chart_neighbours(TexelGraph graph, const Texels& texels);

}  // namespace oriel
