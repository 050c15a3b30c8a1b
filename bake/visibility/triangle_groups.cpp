#include "bake/visibility/triangle_groups.h"

#include <algorithm>
#include <functional>

namespace oriel {
namespace {

using Items = std::span<std::uint32_t>;

// Cuts items at the middle of the longest side of their places' box, and on until `whole` is content with a piece,
// which is then `kept`. The same for the same places in the same order.
void halve(Items items, const std::vector<Vec3>& places, const std::function<bool(Items)>& whole,
           const std::function<void(Items)>& kept) {
  if (items.size() <= 1 || whole(items)) return kept(items);
  Vec3 low = places[items[0]], high = low;
  for (const std::uint32_t i : items) low = glm::min(low, places[i]), high = glm::max(high, places[i]);
  const Vec3 size = high - low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  std::sort(items.begin(), items.end(), [&](std::uint32_t a, std::uint32_t b) {
    return places[a][axis] < places[b][axis] || (places[a][axis] == places[b][axis] && a < b);
  });
  halve(items.first(items.size() / 2), places, whole, kept);
  halve(items.subspan(items.size() / 2), places, whole, kept);
}

using TrianglePiece = std::vector<std::uint32_t>;  // triangles

std::vector<std::uint32_t> ascending(std::size_t first, std::size_t count) {
  std::vector<std::uint32_t> items(count);
  for (std::size_t i = 0; i < count; ++i) items[i] = static_cast<std::uint32_t>(first + i);
  return items;
}

}  // namespace

TriangleGroups group_triangles(const Mesh& mesh, std::uint32_t most) {
  std::vector<Vec3> middles;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const auto corner = [&](std::size_t k) { return mesh.positions[mesh.indices[i + k]]; };
    middles.push_back((corner(0) + corner(1) + corner(2)) / 3.0f);
  }
  std::vector<TrianglePiece> pieces;
  std::vector<Vec3> places;  // of pieces
  for (const MeshPart& part : mesh.parts) {
    std::vector<std::uint32_t> triangles = ascending(part.first_index / 3, part.index_count / 3);
    halve(
        triangles, middles, [&](Items items) { return items.size() <= most; },
        [&](Items items) {
          if (items.empty()) return;
          Vec3 sum(0);
          for (const std::uint32_t t : items) sum += middles[t];
          places.push_back(sum / static_cast<float>(items.size()));
          pieces.emplace_back(items.begin(), items.end());
        });
  }
  TriangleGroups out;
  out.groups.resize(middles.size());
  std::vector<std::uint32_t> all = ascending(0, pieces.size());
  halve(
      all, places,
      [&](Items items) {
        std::size_t sum = 0;
        for (const std::uint32_t p : items) sum += pieces[p].size();
        return sum <= most;
      },
      [&](Items items) {
        for (const std::uint32_t p : items)
          for (const std::uint32_t t : pieces[p]) out.groups[t] = out.count;
        out.count += !items.empty();
      });
  for (const MeshPart& part : mesh.parts) {
    std::vector<std::uint32_t> triangles = ascending(part.first_index / 3, part.index_count / 3);
    std::stable_sort(triangles.begin(), triangles.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return out.groups[a] < out.groups[b]; });
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const std::uint32_t group = out.groups[triangles[i]];
      if (i == 0 || out.runs.back().group != group) out.runs.push_back({0, group});
      out.runs.back().index_count += 3;
    }
    out.order.insert(out.order.end(), triangles.begin(), triangles.end());
  }
  return out;
}

}  // namespace oriel
