#include "player/scene/glass_bodies.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <tuple>

#include "formats/core/disjoint_sets.h"
#include "player/scene/glass_tree.h"

namespace oriel {
namespace {

constexpr float kOnPlane = 1e-4f;     // of a body's radius
constexpr float kSameNormal = 1e-6f;  // 1 - cosine
constexpr double kHidden = 1e-3;      // of a body's area, that its middle may not see

struct BodyTriangle {
  std::array<std::uint32_t, 3> corners;  // into Mesh::positions
  std::int32_t page;
};

struct ByPlace {
  bool operator()(const Vec3& a, const Vec3& b) const { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }
};

// Triangles that share positions, in the order of their first ones.
std::vector<std::vector<BodyTriangle>> connected(const Mesh& mesh, const std::vector<BodyTriangle>& triangles) {
  std::map<Vec3, std::size_t, ByPlace> first;  // a triangle there
  DisjointSets joined(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const std::uint32_t corner : triangles[t].corners)
      joined.join(t, first.try_emplace(mesh.positions[corner], t).first->second);
  std::map<std::size_t, std::size_t> number;
  std::vector<std::vector<BodyTriangle>> out;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto [at, added] = number.try_emplace(joined.root(t), out.size());
    if (added) out.emplace_back();
    out[at->second].push_back(triangles[t]);
  }
  return out;
}

// Twice the area long.
DVec3 normal_of(const Mesh& mesh, const BodyTriangle& t) {
  const DVec3 a(mesh.positions[t.corners[0]]);
  return glm::cross(DVec3(mesh.positions[t.corners[1]]) - a, DVec3(mesh.positions[t.corners[2]]) - a);
}

DVec3 middle_of(const Mesh& mesh, const std::vector<BodyTriangle>& shell) {
  DVec3 sum(0);
  double area = 0;
  for (const BodyTriangle& t : shell) {
    const double weight = glm::length(normal_of(mesh, t));
    for (const std::uint32_t corner : t.corners) sum += weight / 3 * DVec3(mesh.positions[corner]);
    area += weight;
  }
  return area > 0 ? sum / area : sum;
}

bool is_seen_from(const Mesh& mesh, const std::vector<BodyTriangle>& shell, const DVec3& middle) {
  double area = 0, hidden = 0;
  for (const BodyTriangle& t : shell) {
    const DVec3 normal = normal_of(mesh, t);
    area += glm::length(normal);
    if (!(glm::dot(normal, DVec3(mesh.positions[t.corners[0]]) - middle) > 0)) hidden += glm::length(normal);
  }
  return area > 0 && hidden <= kHidden * area;
}

// Whether they enclose something that their fronts face away from: at each edge as many go one way as the other.
bool encloses(const Mesh& mesh, const std::vector<BodyTriangle>& shell) {
  std::map<Vec3, int, ByPlace> numbers;
  std::map<std::pair<int, int>, int> edges;
  double volume = 0;
  const DVec3 origin(mesh.positions[shell.front().corners[0]]);
  for (const BodyTriangle& t : shell) {
    std::array<int, 3> at;
    for (std::size_t c = 0; c < 3; ++c)
      at[c] = numbers.try_emplace(mesh.positions[t.corners[c]], static_cast<int>(numbers.size())).first->second;
    for (std::size_t c = 0; c < 3; ++c) {
      const int a = at[c], b = at[(c + 1) % 3];
      if (a != b) edges[std::minmax(a, b)] += a < b ? 1 : -1;
    }
    volume += glm::dot(normal_of(mesh, t), DVec3(mesh.positions[t.corners[0]]) - origin);
  }
  return volume > 0 && std::ranges::all_of(edges, [](const auto& edge) { return edge.second == 0; });
}

std::vector<GlassTriangle> triangles_of(const Mesh& mesh, const std::vector<BodyTriangle>& shell) {
  std::vector<GlassTriangle> out;
  for (const BodyTriangle& t : shell) {
    GlassTriangle& triangle = out.emplace_back();
    for (std::size_t c = 0; c < 3; ++c)
      triangle.corners[c] = mesh.positions[t.corners[c]], triangle.normals[c] = mesh.normals[t.corners[c]];
  }
  return out;
}

// None where there are too many, or where the body is not convex.
std::vector<Vec4> planes_of(const Mesh& mesh, const std::vector<BodyTriangle>& shell, float radius) {
  std::vector<Vec4> planes;
  for (const BodyTriangle& t : shell) {
    const DVec3 normal = normal_of(mesh, t);
    if (!(glm::length(normal) > 0)) continue;
    const Vec3 n(glm::normalize(normal));
    const float w = -glm::dot(n, mesh.positions[t.corners[0]]);
    const bool known = std::ranges::any_of(planes, [&](const Vec4& p) {
      return glm::dot(Vec3(p), n) > 1 - kSameNormal && std::abs(p.w - w) <= kOnPlane * radius;
    });
    if (known) continue;
    if (planes.size() == kMaxBodyPlanes) return {};
    planes.emplace_back(n, w);
  }
  for (const BodyTriangle& t : shell)
    for (const std::uint32_t corner : t.corners)
      for (const Vec4& p : planes)
        if (glm::dot(Vec3(p), mesh.positions[corner]) + p.w > kOnPlane * radius) return {};
  return planes;
}

// One range a page.
std::vector<DrawRange> append(const Mesh& mesh, std::vector<BodyTriangle> triangles, std::uint32_t material,
                              std::vector<std::uint32_t>& indices) {
  std::stable_sort(triangles.begin(), triangles.end(),
                   [](const BodyTriangle& a, const BodyTriangle& b) { return a.page < b.page; });
  std::vector<DrawRange> ranges;
  for (const BodyTriangle& t : triangles) {
    if (ranges.empty() || ranges.back().lightmap_page != t.page)
      ranges.push_back({static_cast<std::uint32_t>(indices.size()), 0, material, t.page, {}, DrawRange::kNoGroup});
    for (const std::uint32_t corner : t.corners) ranges.back().bounds.extend(mesh.positions[corner]);
    indices.insert(indices.end(), t.corners.begin(), t.corners.end());
    ranges.back().index_count += 3;
  }
  return ranges;
}

bool is_frosted_pane(const Material& m) {
  return m.transmission > 0 && m.metallic < 1 && m.roughness > kClearGlass && m.alpha_mode == AlphaMode::kOpaque &&
         !m.unlit;
}

std::optional<GlassBody> body_of(const Mesh& mesh, const std::vector<BodyTriangle>& shell, const GlassBody& kind) {
  const DVec3 middle = middle_of(mesh, shell);
  const bool star = kind.pane || is_seen_from(mesh, shell, middle);
  if (!star && (shell.size() > kMaxTreeTriangles || !encloses(mesh, shell))) return std::nullopt;
  GlassBody body = kind;
  body.centre = Vec3(middle);
  for (const BodyTriangle& t : shell)
    for (const std::uint32_t corner : t.corners) {
      body.bounds.extend(mesh.positions[corner]);
      body.radius = std::max(body.radius, glm::length(mesh.positions[corner] - body.centre));
    }
  if (!(body.radius > 0)) return std::nullopt;
  if (!star) body.tree = glass_tree(triangles_of(mesh, shell));
  if (star && !kind.pane) body.planes = planes_of(mesh, shell, body.radius);
  return body;
}

// Materials that bodies are of.
std::vector<GlassBody> kinds_of(const Pack& pack) {
  std::vector<GlassBody> kinds;
  std::vector<bool> solid(pack.materials.size());
  for (std::uint32_t i = 0; i < pack.solids.size(); ++i) {
    solid[pack.solids[i].material] = true;
    GlassBody& kind = kinds.emplace_back();
    kind.material = pack.solids[i].material, kind.solid = i;
  }
  for (std::uint32_t m = 0; m < pack.materials.size(); ++m)
    if (!solid[m] && is_frosted_pane(pack.materials[m])) {
      GlassBody& kind = kinds.emplace_back();
      kind.material = m, kind.pane = true;
    }
  return kinds;
}

}  // namespace

std::vector<GlassBody> take_glass_bodies(const Pack& pack, std::vector<std::uint32_t>& indices,
                                         std::vector<DrawRange>& ranges) {
  std::vector<GlassBody> bodies;
  for (const GlassBody& kind : kinds_of(pack)) {
    const std::uint32_t material = kind.material;
    std::vector<BodyTriangle> triangles, left;
    for (const DrawRange& range : ranges)
      for (std::uint32_t i = 0; range.material == material && i + 2 < range.index_count; i += 3) {
        const std::uint32_t* corner = &indices[range.first_index + i];
        triangles.push_back({{corner[0], corner[1], corner[2]}, range.lightmap_page});
      }
    if (triangles.empty()) continue;
    std::erase_if(ranges, [&](const DrawRange& range) { return range.material == material; });
    for (const std::vector<BodyTriangle>& shell : connected(pack.mesh, triangles)) {
      std::optional<GlassBody> body = body_of(pack.mesh, shell, kind);
      if (!body) {
        left.insert(left.end(), shell.begin(), shell.end());
        continue;
      }
      body->ranges = append(pack.mesh, shell, material, indices);
      bodies.push_back(std::move(*body));
    }
    const std::vector<DrawRange> thin = append(pack.mesh, left, material, indices);
    ranges.insert(ranges.end(), thin.begin(), thin.end());
  }
  return bodies;
}

void find_lit_sides(const Pack& pack, std::vector<std::uint32_t>& indices, std::span<GlassBody> bodies) {
  if (pack.frosted_panes.empty()) return;
  std::vector<std::uint32_t> body_of(pack.mesh.positions.size(), ~0u);
  for (std::uint32_t b = 0; b < bodies.size(); ++b)
    for (const DrawRange& range : bodies[b].ranges)
      for (std::uint32_t i = 0; bodies[b].pane && i < range.index_count; ++i)
        body_of[indices[range.first_index + i]] = b;
  for (std::uint32_t p = 0; p < pack.frosted_panes.size(); ++p) {
    const std::vector<std::uint32_t>& own = pack.frosted_panes[p].indices;
    for (std::size_t i = 0; i + 2 < own.size(); i += 3) {
      if (body_of[own[i]] == ~0u) continue;
      std::vector<LitSide>& lit = bodies[body_of[own[i]]].lit;
      const auto end = static_cast<std::uint32_t>(indices.size());
      const bool goes_on =
          !lit.empty() && lit.back().pane == p && lit.back().first_index + lit.back().index_count == end;
      if (!goes_on) lit.push_back({p, end, 0});
      lit.back().index_count += 3;
      indices.insert(indices.end(), {own[i], own[i + 1], own[i + 2]});
    }
  }
}

bool is_inside(const GlassBody& body, const Mesh& mesh, std::span<const std::uint32_t> indices, const Vec3& point) {
  if (glm::any(glm::lessThan(point, body.bounds.lower)) || glm::any(glm::greaterThan(point, body.bounds.upper)))
    return false;
  double angle = 0;
  for (const DrawRange& range : body.ranges)
    for (std::uint32_t i = 0; i + 2 < range.index_count; i += 3) {
      std::array<DVec3, 3> way;
      for (std::uint32_t c = 0; c < 3; ++c)
        way[c] = DVec3(mesh.positions[indices[range.first_index + i + c]]) - DVec3(point);
      const double a = glm::length(way[0]), b = glm::length(way[1]), c = glm::length(way[2]);
      const double volume = glm::dot(way[0], glm::cross(way[1], way[2]));
      angle += 2 * std::atan2(volume, a * b * c + glm::dot(way[0], way[1]) * c + glm::dot(way[1], way[2]) * a +
                                          glm::dot(way[2], way[0]) * b);
    }
  return angle > 2 * std::numbers::pi;  // 4 pi inside, 0 outside
}

}  // namespace oriel
