#include "study/support/shadow_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace oriel {
namespace {

// A line as Plücker's coordinates: direction and moment.
struct Line {
  DVec3 along, moment;
};
Line line_through(const DVec4& from, const DVec4& to) {
  return {DVec3(to) * from.w - DVec3(from) * to.w, glm::cross(DVec3(from), DVec3(to))};
}

// On which side of the line an edge passes. a < b as numbers, so that both triangles of an edge get one answer, on the
// line itself too.
bool passes_left(const Line& line, const DVec3& a, const DVec3& b) {
  return glm::dot(line.along, glm::cross(a, b)) + glm::dot(line.moment, b - a) >= 0;
}

std::uint32_t root_of(std::vector<std::uint32_t>& parent, std::uint32_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

constexpr double kFlat = 1e-5;      // of the mesh's size
constexpr double kRounding = 5e-7;  // of its coordinates

// An edge of a triangle, before those of one place are brought together.
struct HalfEdge {
  std::uint64_t key;   // a << 32 | b
  std::uint32_t side;  // as ShadowMesh::sides_
};

}  // namespace

ShadowMesh::ShadowMesh(std::span<const Vec3> positions, std::span<const UVec3> triangles,
                       std::span<const char> throws) {
  given_.assign(triangles.size(), ~0u);
  std::vector<UVec3> throwing;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (!throws.empty() && throws[t] == 0) continue;
    given_[t] = static_cast<std::uint32_t>(throwing.size());
    throwing.push_back(triangles[t]);
  }
  weld(positions, throwing);
  Vec3 lower(0), upper(0);
  for (std::size_t v = 0; v < positions_.size(); ++v) {
    lower = v == 0 ? positions_[v] : glm::min(lower, positions_[v]);
    upper = v == 0 ? positions_[v] : glm::max(upper, positions_[v]);
  }
  // A point on the mesh is rounded as its coordinates are.
  flat_ = kFlat * glm::length(DVec3(upper) - DVec3(lower)) +
          kRounding * double{max_component(glm::max(glm::abs(lower), glm::abs(upper)))};
  for (const UVec3& t : triangles_) {
    const DVec3 a(positions_[t.x]), b(positions_[t.y]), c(positions_[t.z]);
    const DVec3 normal = glm::cross(b - a, c - a);
    planes_.push_back({normal, glm::dot(normal, a)});
  }
  find_edges();
}

std::size_t ShadowMesh::bytes() const {
  return positions_.size() * sizeof(Vec3) + triangles_.size() * (sizeof(UVec3) + sizeof(Plane)) +
         edges_.size() * sizeof(Edge) + sides_.size() * sizeof(std::uint32_t);
}

// Corners at exactly the same place become one; triangles whose corners then are not three are left out.
void ShadowMesh::weld(std::span<const Vec3> positions, std::span<const UVec3> triangles) {
  std::vector<std::uint32_t> corners;
  corners.reserve(3 * triangles.size());
  for (const UVec3& t : triangles)
    for (int k = 0; k < 3; ++k) corners.push_back(t[k]);
  std::vector<std::uint32_t> order = corners;
  const auto place = [&](std::uint32_t v) {
    const Vec3& p = positions[v];
    return std::tuple(p.x, p.y, p.z);
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) { return place(i) < place(j); });
  std::vector<std::uint32_t> welded(positions.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || place(order[i]) != place(order[i - 1])) positions_.push_back(positions[order[i]]);
    welded[order[i]] = static_cast<std::uint32_t>(positions_.size() - 1);
  }
  std::vector<std::uint32_t> kept(triangles.size(), ~0u);
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    const UVec3 t(welded[corners[i]], welded[corners[i + 1]], welded[corners[i + 2]]);
    if (t.x == t.y || t.y == t.z || t.z == t.x) continue;
    kept[i / 3] = static_cast<std::uint32_t>(triangles_.size());
    triangles_.push_back(t);
  }
  for (std::uint32_t& given : given_)
    if (given != ~0u) given = kept[given];
  all_.resize(triangles_.size());
  std::iota(all_.begin(), all_.end(), 0u);
}

void ShadowMesh::find_edges() {
  std::vector<HalfEdge> halves;
  halves.reserve(3 * triangles_.size());
  for (std::uint32_t t = 0; t < triangles_.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const std::uint64_t from = triangles_[t][k], to = triangles_[t][(k + 1) % 3];
      halves.push_back({std::min(from, to) << 32 | std::max(from, to), 2 * t + (from < to ? 1u : 0u)});
    }
  std::sort(halves.begin(), halves.end(),
            [](const HalfEdge& x, const HalfEdge& y) { return std::tie(x.key, x.side) < std::tie(y.key, y.side); });
  body_.resize(triangles_.size());
  std::iota(body_.begin(), body_.end(), 0u);
  for (std::size_t i = 0; i < halves.size(); ++i) {
    if (i == 0 || halves[i].key != halves[i - 1].key)
      edges_.push_back({static_cast<std::uint32_t>(halves[i].key >> 32), static_cast<std::uint32_t>(halves[i].key),
                        static_cast<std::uint32_t>(i)});
    else
      body_[root_of(body_, halves[i].side / 2)] = root_of(body_, halves[i - 1].side / 2);
    sides_.push_back(halves[i].side);
  }
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) body_[t] = root_of(body_, t);
  even_.assign(triangles_.size(), 1);
  const auto end_of = [&](std::size_t e) { return e + 1 < edges_.size() ? edges_[e + 1].first : sides_.size(); };
  for (std::size_t e = 0; e < edges_.size(); ++e)
    if ((end_of(e) - edges_[e].first) % 2 != 0) even_[body_[sides_[edges_[e].first] / 2]] = 0;
  for (Edge& edge : edges_) edge.halved = even_[body_[sides_[edge.first] / 2]] != 0;
}

// Whether a triangle's front is towards it.
bool ShadowMesh::faces(std::size_t triangle, const Vec4& from) const {
  const Plane& plane = planes_[triangle];
  return glm::dot(plane.normal, DVec3(from)) - plane.offset * double{from.w} >= 0;
}

ShadowMesh::Side ShadowMesh::side_of(std::size_t triangle, const Vec4& light) const {
  const Plane& plane = planes_[triangle];
  const double height = glm::dot(plane.normal, DVec3(light)) - plane.offset * double{light.w};
  const double near = light.w == 0 ? 1e-9 : flat_;
  if (std::abs(height) <= near * glm::length(plane.normal)) return kEdgeOn;
  return height > 0 ? kFacing : kAway;
}

// Whether the line from a place to the light meets the triangle between them. lit: it faces the light.
bool ShadowMesh::crossed(std::size_t triangle, const Vec4& place, const Vec4& light, bool lit) const {
  if (faces(triangle, place) == lit) return false;
  const Line line = line_through(DVec4(place), DVec4(light));
  const auto left = [&](std::uint32_t from, std::uint32_t to) {
    const bool of_edge =
        passes_left(line, DVec3(positions_[std::min(from, to)]), DVec3(positions_[std::max(from, to)]));
    return of_edge == (from < to);
  };
  const UVec3& v = triangles_[triangle];
  const bool first = left(v.x, v.y);
  return left(v.y, v.z) == first && left(v.z, v.x) == first;
}

std::uint32_t ShadowMesh::triangles_between(const Vec4& place, const Vec4& light) const {
  std::uint32_t count = 0;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const Side side = side_of(t, light);
    if (side != kEdgeOn && crossed(t, place, light, side == kFacing)) ++count;
  }
  return count;
}

// The quads of edges from which shadow goes on. turns: by triangle 1 where it faces the light, -1 where not, 0: it
// throws none.
void ShadowMesh::add_sides(std::span<const signed char> turns, bool halve, std::vector<std::uint32_t>& indices) const {
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const Edge& edge = edges_[e];
    const std::size_t end = e + 1 < edges_.size() ? edges_[e + 1].first : sides_.size();
    int net = 0;  // how often the triangles, turned to the light, go from a to b, less how often back
    for (std::size_t i = edge.first; i < end; ++i)
      net += sides_[i] % 2 != 0 ? turns[sides_[i] / 2] : -turns[sides_[i] / 2];
    const std::uint32_t from = 2 * (net > 0 ? edge.a : edge.b), to = 2 * (net > 0 ? edge.b : edge.a);
    for (int i = halve && edge.halved ? std::abs(net) / 2 : std::abs(net); i > 0; --i)
      indices.insert(indices.end(), {to, from, from + 1, to, from + 1, to + 1});
  }
}

ShadowMesh::WholeVolumes ShadowMesh::whole_volumes(const Vec4& light) const {
  WholeVolumes out;
  std::vector<Side> sides(triangles_.size());
  std::vector<signed char> turns;
  for (std::size_t t = 0; t < sides.size(); ++t) {
    sides[t] = side_of(t, light);
    turns.push_back(sides[t] == kEdgeOn ? 0 : sides[t] == kFacing ? 1 : -1);
  }
  add_sides(turns, false, out.indices);
  out.sides = out.indices.size();
  for (std::size_t t = 0; t < sides.size(); ++t) {
    if (sides[t] == kEdgeOn) continue;
    const UVec3 v = 2u * triangles_[t];
    if (sides[t] == kFacing)
      out.indices.insert(out.indices.end(), {v.x, v.y, v.z});
    else
      out.indices.insert(out.indices.end(), {v.z, v.y, v.x});
  }
  return out;
}

// Triangles between eye and light, those of an even body as pairs.
std::uint32_t ShadowMesh::volumes_around(const Vec4& eye, const Vec4& light, const std::vector<char>& lit,
                                         std::span<const std::uint32_t> asked) const {
  std::vector<std::uint32_t> bodies;
  for (const std::uint32_t t : asked)
    if (crossed(t, eye, light, lit[t] != 0)) bodies.push_back(body_[t]);
  std::sort(bodies.begin(), bodies.end());
  std::uint32_t count = 0;
  for (std::size_t i = 0, end = 0; i < bodies.size(); i = end) {
    for (end = i; end < bodies.size() && bodies[end] == bodies[i];) ++end;
    const auto times = static_cast<std::uint32_t>(end - i);
    count += even_[bodies[i]] ? (times + 1) / 2 : times;
  }
  return count;
}

ShadowVolumes ShadowMesh::volumes(const Vec4& light, const Vec4& eye,
                                  const std::optional<std::vector<std::uint32_t>>& asked) const {
  ShadowVolumes out;
  std::vector<char> lit(planes_.size());
  for (std::size_t t = 0; t < lit.size(); ++t) lit[t] = faces(t, light);
  std::vector<signed char> turns;
  for (const char facing : lit) turns.push_back(facing != 0 ? 1 : -1);
  add_sides(turns, true, out.indices);
  std::vector<std::uint32_t> some;
  for (const std::uint32_t t : asked.value_or(std::vector<std::uint32_t>()))
    if (given_[t] != ~0u) some.push_back(given_[t]);
  out.around_eye = volumes_around(eye, light, lit, asked ? some : all_);
  return out;
}

}  // namespace oriel
