#include "bake/atlas/patch.h"

namespace oriel {

std::vector<Patch> pieces_by_label(const Patch& patch, std::span<const std::uint32_t> label) {
  std::vector<Patch> pieces;
  std::vector<std::uint32_t> slot(patch.size(), kNoEdge), queue;
  for (std::uint32_t seed = 0; seed < patch.size(); ++seed) {
    if (slot[seed] != kNoEdge) continue;
    queue.assign(1, seed);
    slot[seed] = 0;
    for (std::size_t i = 0; i < queue.size(); ++i) {
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t other = patch.across[3 * queue[i] + k];
        if (other == kNoEdge || label[other / 3] != label[seed] || slot[other / 3] != kNoEdge) continue;
        slot[other / 3] = static_cast<std::uint32_t>(queue.size());
        queue.push_back(other / 3);
      }
    }
    Patch& piece = pieces.emplace_back();
    for (const std::uint32_t i : queue) {
      piece.faces.push_back(patch.faces[i]);
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t other = patch.across[3 * i + k];
        const bool inside = other != kNoEdge && label[other / 3] == label[seed];
        piece.across.push_back(inside ? 3 * slot[other / 3] + other % 3 : kNoEdge);
      }
    }
  }
  return pieces;
}

PatchVertices number_vertices(const Patch& patch) {
  PatchVertices out;
  out.of_corner.assign(3 * patch.size(), kNoEdge);
  for (std::uint32_t start = 0; start < out.of_corner.size(); ++start) {
    if (out.of_corner[start] != kNoEdge) continue;
    const std::uint32_t vertex = out.count++;
    // Counter-clockwise around the vertex over the edges that end in it, then clockwise if that met the outline.
    std::uint32_t corner = start;
    while (corner != kNoEdge && out.of_corner[corner] == kNoEdge) {
      out.of_corner[corner] = vertex;
      corner = patch.across[next_edge(next_edge(corner))];
    }
    for (corner = patch.across[start]; corner != kNoEdge && out.of_corner[next_edge(corner)] == kNoEdge;
         corner = patch.across[next_edge(corner)])
      out.of_corner[next_edge(corner)] = vertex;
  }
  return out;
}

std::vector<OutlineEdge> outline(const Patch& patch, std::span<const Triangle2> points) {
  std::vector<OutlineEdge> edges;
  std::vector<std::uint32_t> index(patch.across.size(), kNoEdge), border;
  for (std::uint32_t e = 0; e < patch.across.size(); ++e) {
    if (patch.across[e] != kNoEdge) continue;
    index[e] = static_cast<std::uint32_t>(edges.size());
    border.push_back(e);
    edges.push_back({points[e / 3][e % 3], points[e / 3][(e + 1) % 3], 0});
  }
  for (std::size_t i = 0; i < border.size(); ++i) {
    std::uint32_t next = next_edge(border[i]);  // turn around its end until the outline goes on
    while (patch.across[next] != kNoEdge) next = next_edge(patch.across[next]);
    edges[i].next = index[next];
  }
  return edges;
}

}  // namespace oriel
