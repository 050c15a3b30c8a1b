// What is odd about a surface as a solid: edges that more than two triangles share, neighbours that face opposite ways.
#pragma once

#include <span>

#include "formats/core/vec.h"

namespace oriel {

inline constexpr std::size_t kMaxSoupTriangles = 2'000'000;  // beyond it the check would take longer than it is worth

struct SoupReport {
  std::size_t non_manifold_edges = 0;     // of more than two triangles
  std::size_t misoriented_triangles = 0;  // that face against the majority of those they are connected with
};

// Corners at the same place are taken as one. Indices must be below positions.size(). Nothing is changed.
SoupReport inspect_soup(std::span<const Vec3> positions, std::span<const UVec3> triangles);

}  // namespace oriel
