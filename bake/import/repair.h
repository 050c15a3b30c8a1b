// What is odd about a surface as a solid: edges that more than two triangles share, neighbours that face opposite ways.
#pragma once

#include <cstdint>
#include <span>

namespace oriel {

inline constexpr std::size_t kMaxSoupTriangles = 2'000'000;  // beyond it the check would take longer than it is worth

struct SoupReport {
  std::size_t non_manifold_edges = 0;     // of more than two triangles
  std::size_t misoriented_triangles = 0;  // that face against the majority of those they are connected with
};

// Of three welded vertices a triangle (edges.h).
SoupReport inspect_soup(std::span<const std::uint32_t> corners);

}  // namespace oriel
