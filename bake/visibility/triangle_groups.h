// Triangles that lie together, so that a few hundred bits say what is seen.
#pragma once

#include "formats/query/visible_sets.h"

namespace oriel {

struct TriangleGroups {
  std::uint32_t count = 0;
  std::vector<std::uint32_t> order;   // the mesh's triangles, those of each part where its own are
  std::vector<TriangleRun> runs;      // of that order
  std::vector<std::uint32_t> groups;  // by triangle of the mesh as it is
};

// Groups of at most `most` triangles (> 0): each part is halved across its longest side until its pieces are no larger,
// then small pieces of any parts are put together where they are near. parts: one after the other, filling the indices.
TriangleGroups group_triangles(const Mesh& mesh, std::uint32_t most);

}  // namespace oriel
