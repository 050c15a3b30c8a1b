#include "formats/query/mesh_rays.h"

#include <algorithm>
#include <array>

namespace oriel {
namespace {

constexpr std::uint32_t kLeaf = 4, kNoPart = ~0u;
constexpr int kDeepest = 64, kBins = 16;
constexpr float kVisit = 1;  // a box costs as much as a triangle, about

struct Box {
  Vec3 lower{std::numeric_limits<float>::infinity()}, upper{-std::numeric_limits<float>::infinity()};
  void add(const Vec3& low, const Vec3& high) { lower = glm::min(lower, low), upper = glm::max(upper, high); }
  float half_area() const {
    const Vec3 d = upper - lower;
    return d.x >= 0 ? d.x * d.y + d.y * d.z + d.z * d.x : 0.0f;
  }
};

// How far along the ray the box begins; infinite where it is not met before `farthest`. A direction that is 0 along an
// axis divides to infinity there.
float entry(const Vec3& lower, const Vec3& upper, const Vec3& from, const Vec3& inverse, float farthest) {
  const Vec3 a = (lower - from) * inverse, b = (upper - from) * inverse;
  const Vec3 in = glm::min(a, b), out = glm::max(a, b);
  const float enter = std::max({in.x, in.y, in.z, 0.0f}), leave = std::min({out.x, out.y, out.z, farthest});
  // Rounding may not lose a flat box.
  return enter <= leave * (1 + 1e-5f) + 1e-6f ? enter : std::numeric_limits<float>::infinity();
}

}  // namespace

struct MeshRays::Boxed {
  Corners corners;
  Vec3 lower{0}, upper{0}, centre{0};
};

MeshRays::MeshRays(const Mesh& mesh) : mesh_(&mesh), part_of_(mesh.indices.size() / 3, kNoPart) {
  for (std::uint32_t p = 0; p < mesh.parts.size(); ++p) {
    const std::size_t first = mesh.parts[p].first_index / 3, end = first + mesh.parts[p].index_count / 3;
    for (std::size_t t = first; t < std::min(end, part_of_.size()); ++t) part_of_[t] = p;
  }
  std::vector<Boxed> triangles;
  triangles.reserve(part_of_.size());
  for (std::size_t t = 0; t < part_of_.size(); ++t) {
    const auto corner = [&](std::size_t c) { return mesh.positions[mesh.indices[3 * t + c]]; };
    const Vec3 a = corner(0), b = corner(1), c = corner(2);
    const Vec3 lower = glm::min(a, glm::min(b, c)), upper = glm::max(a, glm::max(b, c));
    triangles.push_back({{a, b - a, c - a, static_cast<std::uint32_t>(t)}, lower, upper, 0.5f * lower + 0.5f * upper});
  }
  nodes_.emplace_back();
  corners_.reserve(triangles.size());
  if (!triangles.empty()) build(0, triangles, 0);
}

// Where a plane parts the fewest expected visits (surface area heuristic in bins: Wald 2007, "On fast Construction of
// SAH-based Bounding Volume Hierarchies"); in halves where no plane parts them.
void MeshRays::build(std::uint32_t node, std::span<Boxed> triangles, int depth) {
  Box box, centres;
  for (const Boxed& t : triangles) box.add(t.lower, t.upper), centres.add(t.centre, t.centre);
  nodes_[node].lower = box.lower, nodes_[node].upper = box.upper;
  const Vec3 size = centres.upper - centres.lower;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  if (triangles.size() <= kLeaf || depth + 1 >= kDeepest || !(size[axis] > 0)) {
    nodes_[node].first = static_cast<std::uint32_t>(corners_.size());
    nodes_[node].count = static_cast<std::uint32_t>(triangles.size());
    for (const Boxed& t : triangles) corners_.push_back(t.corners);
    return;
  }
  const auto bin_of = [&](const Boxed& t) {
    return std::clamp(static_cast<int>((t.centre[axis] - centres.lower[axis]) / size[axis] * kBins), 0, kBins - 1);
  };
  std::array<Box, kBins> boxes;
  std::array<std::size_t, kBins> counts{};
  for (const Boxed& t : triangles) boxes[bin_of(t)].add(t.lower, t.upper), ++counts[bin_of(t)];
  std::array<float, kBins> above{};
  Box sum;
  std::size_t count = 0;
  for (int b = kBins - 1; b > 0; --b) {
    sum.add(boxes[b].lower, boxes[b].upper), count += counts[b];
    above[b] = sum.half_area() * static_cast<float>(count);
  }
  sum = {}, count = 0;
  int best = 0;
  float least = std::numeric_limits<float>::infinity();
  for (int b = 1; b < kBins; ++b) {
    sum.add(boxes[b - 1].lower, boxes[b - 1].upper), count += counts[b - 1];
    const float cost = kVisit + sum.half_area() * static_cast<float>(count) + above[b];
    if (count > 0 && count < triangles.size() && cost < least) best = b, least = cost;
  }
  auto middle = triangles.begin() + static_cast<std::ptrdiff_t>(triangles.size() / 2);
  if (best > 0)
    middle = std::partition(triangles.begin(), triangles.end(), [&](const Boxed& t) { return bin_of(t) < best; });
  else
    std::nth_element(triangles.begin(), middle, triangles.end(),
                     [&](const Boxed& a, const Boxed& b) { return a.centre[axis] < b.centre[axis]; });
  const auto children = static_cast<std::uint32_t>(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
  nodes_[node].first = children, nodes_[node].count = 0;
  const auto half = static_cast<std::size_t>(middle - triangles.begin());
  build(children, triangles.first(half), depth + 1);
  build(children + 1, triangles.subspan(half), depth + 1);
}

template <class Visit>
void MeshRays::along(const Vec3& from, const Vec3& direction, const float& farthest, const Visit& visit) const {
  if (corners_.empty()) return;
  constexpr float kNever = std::numeric_limits<float>::infinity();
  const Vec3 inverse = 1.0f / direction;
  struct Left {
    std::uint32_t node;
    float entry;
  };
  std::array<Left, kDeepest + 2> stack;
  int top = 0;
  if (entry(nodes_[0].lower, nodes_[0].upper, from, inverse, farthest) < kNever) stack[top++] = {0, 0};
  while (top > 0) {
    const Left left = stack[--top];
    if (left.entry > farthest * (1 + 1e-5f) + 1e-6f) continue;
    const Node& node = nodes_[left.node];
    if (node.count == 0) {
      const Node &a = nodes_[node.first], &b = nodes_[node.first + 1];
      const float to_a = entry(a.lower, a.upper, from, inverse, farthest),
                  to_b = entry(b.lower, b.upper, from, inverse, farthest);
      const Left first{node.first, to_a}, second{node.first + 1, to_b};
      const bool a_first = to_a <= to_b;
      if (std::max(to_a, to_b) < kNever) stack[top++] = a_first ? second : first;
      if (std::min(to_a, to_b) < kNever) stack[top++] = a_first ? first : second;
      continue;
    }
    for (std::uint32_t k = node.first; k < node.first + node.count; ++k)
      if (!visit(corners_[k])) return;
  }
}

std::optional<TriangleHit> MeshRays::first(const Vec3& from, const Vec3& direction, float farthest) const {
  constexpr float kBeyond = 1 + 2e-5f;  // of the nearest so far: the other side of a sheet may be told a little farther
  std::optional<TriangleHit> best;
  float reach = farthest;
  along(from, direction, reach, [&](const Corners& c) {
    auto hit = meet_triangle(c.a, c.ab, c.ac, from, direction);
    if (!hit || !(hit->distance <= farthest)) return true;
    hit->first_index = std::size_t{3} * c.triangle;
    if (best && !hit->comes_before(*best)) return true;
    best = hit;
    reach = std::min(farthest, kBeyond * hit->distance);
    return true;
  });
  return best;
}

bool MeshRays::blocks(const Vec3& from, const Vec3& to, std::uint32_t& last) const {
  constexpr float kEnd = 1 - 1e-4f;
  const Vec3 direction = to - from;
  const auto is_met = [&](const Corners& c) {
    const auto hit = meet_triangle(c.a, c.ab, c.ac, from, direction);
    return hit && hit->distance < kEnd;
  };
  if (last < corners_.size() && is_met(corners_[last])) return true;
  bool found = false;
  along(from, direction, kEnd, [&](const Corners& c) {
    found = is_met(c);
    if (found) last = static_cast<std::uint32_t>(&c - corners_.data());
    return !found;
  });
  return found;
}

std::optional<std::uint32_t> MeshRays::part(std::size_t first_index) const {
  const std::uint32_t part = part_of_[first_index / 3];
  return part == kNoPart ? std::nullopt : std::optional(part);
}

}  // namespace oriel
