#include "study/herf1997/occluders.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace oriel::study {
namespace {

constexpr std::uint32_t kLeafFaces = 8;

bool before(const DVec3& a, const DVec3& b) {
  return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
}

}  // namespace

Occluders::Occluders(std::span<const DVec3> all, std::span<const std::array<std::uint32_t, 3>> triangles) {
  weld(all, triangles);
  find_parts();
  if (faces.empty()) return;
  nodes.push_back({.first = 0, .count = static_cast<std::uint32_t>(faces.size())});
  for (std::uint32_t n = 0; n < nodes.size(); ++n) split(n);
}

void Occluders::weld(std::span<const DVec3> all, std::span<const std::array<std::uint32_t, 3>> triangles) {
  std::vector<std::uint32_t> order(all.size()), point_of(all.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) { return before(all[a], all[b]); });
  for (const std::uint32_t i : order) {
    if (points.empty() || points.back() != all[i]) points.push_back(all[i]);
    point_of[i] = static_cast<std::uint32_t>(points.size() - 1);
  }
  for (const auto& t : triangles) {
    const OccluderFace face{{point_of[t[0]], point_of[t[1]], point_of[t[2]]}};
    const DVec3 &a = points[face.points[0]], &b = points[face.points[1]], &c = points[face.points[2]];
    if (glm::cross(b - a, c - a) != DVec3(0)) faces.push_back(face);
  }
}

void Occluders::find_parts() {
  std::vector<std::uint32_t> root(points.size());
  std::iota(root.begin(), root.end(), 0u);
  const auto find = [&](std::uint32_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  for (const OccluderFace& f : faces)
    for (int k = 1; k < 3; ++k) root[find(f.points[k])] = find(f.points[0]);
  std::map<std::uint32_t, std::uint32_t> part_of;
  for (OccluderFace& f : faces) {
    f.part = part_of.try_emplace(find(f.points[0]), static_cast<std::uint32_t>(parts.size())).first->second;
    if (f.part == parts.size()) parts.push_back({true, points[f.points[0]], points[f.points[0]]});
    OccluderPart& part = parts[f.part];
    for (const std::uint32_t p : f.points)
      part.lower = min(part.lower, points[p]), part.upper = max(part.upper, points[p]);
  }
  // Closed: every directed edge once, and its reverse once.
  std::vector<std::array<std::uint32_t, 3>> edges;  // from, to, part
  for (const OccluderFace& f : faces)
    for (int k = 0; k < 3; ++k) edges.push_back({f.points[k], f.points[(k + 1) % 3], f.part});
  std::ranges::sort(edges);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto& e = edges[i];
    const bool twice = i + 1 < edges.size() && edges[i + 1][0] == e[0] && edges[i + 1][1] == e[1];
    if (twice || !std::ranges::binary_search(edges, std::array{e[1], e[0], e[2]})) parts[e[2]].closed = false;
  }
}

void Occluders::split(std::uint32_t index) {
  const std::uint32_t first = nodes[index].first, count = nodes[index].count;
  DVec3 lower(1e300), upper(-1e300), least(1e300), most(-1e300);
  const auto middle = [&](const OccluderFace& f) {
    return points[f.points[0]] + points[f.points[1]] + points[f.points[2]];
  };
  for (std::uint32_t i = first; i < first + count; ++i) {
    for (const std::uint32_t p : faces[i].points) lower = min(lower, points[p]), upper = max(upper, points[p]);
    least = min(least, middle(faces[i])), most = max(most, middle(faces[i]));
  }
  nodes[index].lower = lower, nodes[index].upper = upper;
  if (count <= kLeafFaces) return;
  const DVec3 size = most - least;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto begin = faces.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count,
                   [&](const OccluderFace& a, const OccluderFace& b) { return middle(a)[axis] < middle(b)[axis]; });
  nodes[index].left = static_cast<std::uint32_t>(nodes.size());
  nodes.push_back({.first = first, .count = count / 2});
  nodes.push_back({.first = first + count / 2, .count = count - count / 2});
}

}  // namespace oriel::study
