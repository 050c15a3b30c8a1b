#include "player/scene/glass_tree.h"

#include <algorithm>
#include <span>

#include "player/navigation/culling.h"

namespace oriel {
namespace {

constexpr std::size_t kLeaf = 4;  // triangles, at most 7

Bounds bounds_of(std::span<const GlassTriangle> triangles) {
  Bounds box;
  for (const GlassTriangle& t : triangles)
    for (const Vec3& corner : t.corners) box.extend(corner);
  return box;
}

float middle_along(const GlassTriangle& t, int axis) {
  return t.corners[0][axis] + t.corners[1][axis] + t.corners[2][axis];
}

// Half of them on each side, along the axis on which their middles lie farthest apart.
void divide(std::span<GlassTriangle> triangles) {
  Bounds middles;
  for (const GlassTriangle& t : triangles) middles.extend(t.corners[0] + t.corners[1] + t.corners[2]);
  const Vec3 size = middles.upper - middles.lower;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  std::ranges::nth_element(triangles, triangles.begin() + static_cast<std::ptrdiff_t>(triangles.size() / 2), {},
                           [&](const GlassTriangle& t) { return middle_along(t, axis); });
}

// first: of them, of all.
void add_nodes(std::vector<Vec4>& out, std::span<GlassTriangle> triangles, std::size_t first) {
  const Bounds box = bounds_of(triangles);
  const std::size_t at = out.size();
  const bool leaf = triangles.size() <= kLeaf;
  out.emplace_back(box.lower, 0);
  out.emplace_back(box.upper, leaf ? static_cast<float>(8 * first + triangles.size()) : -1.0f);
  if (!leaf) {
    divide(triangles);
    const std::size_t half = triangles.size() / 2;
    add_nodes(out, triangles.first(half), first);
    add_nodes(out, triangles.subspan(half), first + half);
  }
  out[at].w = static_cast<float>(out.size() / 2);
}

}  // namespace

std::vector<Vec4> glass_tree(std::vector<GlassTriangle> triangles) {
  std::vector<Vec4> out;
  if (triangles.empty()) return out;
  add_nodes(out, triangles, 0);
  for (const GlassTriangle& t : triangles) {
    for (const Vec3& corner : t.corners) out.emplace_back(corner, 0);
    for (const Vec3& normal : t.normals) out.emplace_back(normal, 0);
  }
  return out;
}

}  // namespace oriel
