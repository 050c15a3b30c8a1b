#include "formats/query/mesh_rays.h"

#include <algorithm>
#include <numeric>

namespace oriel {
namespace {

constexpr std::uint32_t kLeaf = 8, kNoPart = ~0u;
constexpr int kDeepest = 64;

// Whether the ray meets the box before `farthest`. A direction that is 0 along an axis divides to infinity there.
bool meets(const Vec3& lower, const Vec3& upper, const Vec3& from, const Vec3& inverse, float farthest) {
  const Vec3 a = (lower - from) * inverse, b = (upper - from) * inverse;
  const Vec3 in = glm::min(a, b), out = glm::max(a, b);
  const float enter = std::max({in.x, in.y, in.z, 0.0f}), leave = std::min({out.x, out.y, out.z, farthest});
  // Rounding may not lose a flat box.
  return enter <= leave * (1 + 1e-5f) + 1e-6f;
}

}  // namespace

MeshRays::MeshRays(const Mesh& mesh) : mesh_(&mesh), part_of_(mesh.indices.size() / 3, kNoPart) {
  for (std::uint32_t p = 0; p < mesh.parts.size(); ++p) {
    const std::size_t first = mesh.parts[p].first_index / 3, end = first + mesh.parts[p].index_count / 3;
    for (std::size_t t = first; t < std::min(end, part_of_.size()); ++t) part_of_[t] = p;
  }
  triangles_.resize(part_of_.size());
  std::iota(triangles_.begin(), triangles_.end(), 0u);
  std::vector<Vec3> centres;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
    centres.push_back(
        (mesh.positions[mesh.indices[i]] + mesh.positions[mesh.indices[i + 1]] + mesh.positions[mesh.indices[i + 2]]) /
        3.0f);
  nodes_.emplace_back();
  build(0, 0, static_cast<std::uint32_t>(triangles_.size()), centres);
}

void MeshRays::build(std::uint32_t node, std::uint32_t first, std::uint32_t count, const std::vector<Vec3>& centres) {
  Vec3 lower(std::numeric_limits<float>::infinity()), upper(-lower), low = lower, high = upper;
  for (std::uint32_t k = first; k < first + count; ++k) {
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3& p = mesh_->positions[mesh_->indices[std::size_t{3} * triangles_[k] + c]];
      lower = glm::min(lower, p), upper = glm::max(upper, p);
    }
    low = glm::min(low, centres[triangles_[k]]), high = glm::max(high, centres[triangles_[k]]);
  }
  nodes_[node].lower = lower, nodes_[node].upper = upper;
  nodes_[node].first = first, nodes_[node].count = count;
  const Vec3 size = high - low;
  if (count <= kLeaf || !(std::max({size.x, size.y, size.z}) > 0)) return;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::uint32_t half = count / 2;
  const auto from = triangles_.begin() + first;
  std::nth_element(from, from + half, from + count, [&](std::uint32_t a, std::uint32_t b) {
    return centres[a][axis] < centres[b][axis] || (centres[a][axis] == centres[b][axis] && a < b);
  });
  const auto children = static_cast<std::uint32_t>(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
  nodes_[node].first = children, nodes_[node].count = 0;
  build(children, first, half, centres);
  build(children + 1, first + half, count - half, centres);
}

template <class Visit>
void MeshRays::along(const Vec3& from, const Vec3& direction, const float& farthest, const Visit& visit) const {
  if (triangles_.empty()) return;
  const Vec3 inverse = 1.0f / direction;
  std::uint32_t stack[kDeepest + 1] = {0};
  int top = 1;
  while (top > 0) {
    const Node& node = nodes_[stack[--top]];
    if (!meets(node.lower, node.upper, from, inverse, farthest)) continue;
    if (node.count == 0) {
      stack[top++] = node.first;
      stack[top++] = node.first + 1;
      continue;
    }
    for (std::uint32_t k = node.first; k < node.first + node.count; ++k)
      if (!visit(std::size_t{3} * triangles_[k])) return;
  }
}

std::optional<TriangleHit> MeshRays::first(const Vec3& from, const Vec3& direction, float farthest) const {
  std::optional<TriangleHit> best;
  float nearest = farthest;
  along(from, direction, nearest, [&](std::size_t first_index) {
    const auto hit = meet_triangle(*mesh_, first_index, from, direction);
    if (!hit || !(hit->distance <= nearest)) return true;
    // Of several in one place the first of the mesh, however the boxes lie.
    if (best && hit->distance == nearest && hit->first_index > best->first_index) return true;
    best = hit;
    nearest = hit->distance;
    return true;
  });
  return best;
}

bool MeshRays::blocks(const Vec3& from, const Vec3& to) const {
  constexpr float kEnd = 1 - 1e-4f;
  const Vec3 direction = to - from;
  bool found = false;
  along(from, direction, kEnd, [&](std::size_t first_index) {
    const auto hit = meet_triangle(*mesh_, first_index, from, direction);
    found = hit && hit->distance < kEnd;
    return !found;
  });
  return found;
}

std::optional<std::uint32_t> MeshRays::part(std::size_t first_index) const {
  const std::uint32_t part = part_of_[first_index / 3];
  return part == kNoPart ? std::nullopt : std::optional(part);
}

}  // namespace oriel
