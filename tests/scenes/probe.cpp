#include "tests/scenes/probe.h"

#include <fmt/format.h>
#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <tuple>

namespace oriel::sample::testing {

std::vector<Triangle> flatten(const SampleScene& scene) {
  std::vector<Triangle> triangles;
  for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
    const Node& node = scene.nodes[n];
    const SampleMesh& mesh = scene.meshes[node.mesh];
    const double c = std::cos(node.yaw_rad), s = std::sin(node.yaw_rad);
    const auto turn = [&](const Vec3& v) { return Vec3(DVec3(c * v.x + s * v.z, v.y, -s * v.x + c * v.z)); };
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      Triangle t;
      for (std::size_t k = 0; k < 3; ++k) {
        t.p[k] = turn(mesh.positions[mesh.indices[i + k]]) + node.position;
        t.normals[k] = turn(mesh.normals[mesh.indices[i + k]]);
      }
      t.node = static_cast<std::uint32_t>(n);
      t.material = mesh.material;
      triangles.push_back(t);
    }
  }
  return triangles;
}

std::string fault(const Triangle& triangle) {
  const DVec3 cross = triangle.cross();
  const double longest =
      std::max({glm::distance(triangle.p[0], triangle.p[1]), glm::distance(triangle.p[1], triangle.p[2]),
                glm::distance(triangle.p[2], triangle.p[0])});
  if (!(glm::length(cross) > 1e-6 * longest * longest)) return fmt::format("area {}", 0.5 * glm::length(cross));
  for (const Vec3& normal : triangle.normals) {
    if (!(std::abs(glm::length(normal) - 1) < 1e-4f)) return fmt::format("normal of length {}", glm::length(normal));
    if (!(glm::dot(DVec3(normal), cross) > 0)) return "normal on the back";
  }
  return "";
}

std::optional<Seen> cast(const std::vector<Triangle>& triangles, const Vec3& origin, const Vec3& direction) {
  std::optional<Seen> best;
  const DVec3 d(direction), o(origin);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Triangle& t = triangles[i];
    const DVec3 a(t.p[0]), u = DVec3(t.p[1]) - a, v = DVec3(t.p[2]) - a, h = glm::cross(d, v);
    const double determinant = glm::dot(u, h);
    if (determinant == 0) continue;
    const DVec3 s = o - a, q = glm::cross(s, u);
    const double x = glm::dot(s, h) / determinant, y = glm::dot(d, q) / determinant;
    if (x < 0 || y < 0 || x + y > 1) continue;
    const double distance = glm::dot(v, q) / determinant;
    if (distance > 0 && (!best || distance < best->distance)) {
      best = Seen{static_cast<std::uint32_t>(i), distance, determinant > 0};
    }
  }
  return best;
}

double distance_to(const Triangle& triangle, const Vec3& point) {
  const DVec3 n = glm::normalize(triangle.cross()), p(point);
  double best = std::numeric_limits<double>::infinity();
  bool inside = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const DVec3 a(triangle.p[k]), edge = DVec3(triangle.p[(k + 1) % 3]) - a;
    inside = inside && glm::dot(glm::cross(edge, p - a), n) >= 0;
    const double t = std::clamp(glm::dot(p - a, edge) / glm::dot(edge, edge), 0.0, 1.0);
    best = std::min(best, glm::distance(p, a + t * edge));
  }
  return inside ? std::abs(glm::dot(p - DVec3(triangle.p[0]), n)) : best;
}

double clearance(const std::vector<Triangle>& triangles, const Vec3& point) {
  double best = std::numeric_limits<double>::infinity();
  for (const Triangle& t : triangles) {
    const Vec3 low = glm::min(t.p[0], glm::min(t.p[1], t.p[2])), high = glm::max(t.p[0], glm::max(t.p[1], t.p[2]));
    if (glm::distance(glm::clamp(point, low, high), point) < best) best = std::min(best, distance_to(t, point));
  }
  return best;
}

namespace {

// Area of the part of polygon `a` inside triangle `b`, both counter-clockwise.
double overlap_area(std::vector<DVec2> a, const std::array<DVec2, 3>& b) {
  const auto cross = [](const DVec2& u, const DVec2& v) { return u.x * v.y - u.y * v.x; };
  for (std::size_t k = 0; k < 3 && !a.empty(); ++k) {
    const DVec2 from = b[k], edge = b[(k + 1) % 3] - from;
    std::vector<DVec2> kept;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const DVec2 here = a[i], next = a[(i + 1) % a.size()];
      const double s = cross(edge, here - from), t = cross(edge, next - from);
      if (s >= 0) kept.push_back(here);
      if ((s > 0 && t < 0) || (s < 0 && t > 0)) kept.push_back(here + (next - here) * (s / (s - t)));
    }
    a = std::move(kept);
  }
  double area = 0;
  for (std::size_t i = 0; i < a.size(); ++i) area += 0.5 * cross(a[i], a[(i + 1) % a.size()]);
  return area;
}

std::array<DVec2, 3> flattened(const Triangle& t, int drop) {
  std::array<DVec2, 3> q;
  for (std::size_t k = 0; k < 3; ++k) q[k] = DVec2(t.p[k][(drop + 1) % 3], t.p[k][(drop + 2) % 3]);
  const DVec2 u = q[1] - q[0], v = q[2] - q[0];
  if (u.x * v.y - u.y * v.x < 0) std::swap(q[1], q[2]);
  return q;
}

}  // namespace

std::vector<std::string> coplanar_overlaps(const SampleScene& scene) {
  const std::vector<Triangle> triangles = flatten(scene);
  // Planes by their unsigned normal and offset: faces of either side.
  using Key = std::array<long, 4>;
  std::map<Key, std::vector<std::uint32_t>> planes;
  std::vector<int> drops(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    DVec3 n = glm::normalize(triangles[i].cross());
    const DVec3 size = glm::abs(n);
    const int drop = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
    drops[i] = drop;
    if (n[drop] < 0) n = -n;
    const double offset = glm::dot(n, DVec3(triangles[i].p[0]));
    // Into both neighbouring classes of offset, so that none is missed at their border.
    for (const double shift : {0.0, 0.5}) {
      planes[{std::lround(n.x * 1e3), std::lround(n.y * 1e3), std::lround(n.z * 1e3),
              2 * std::lround(offset * 1e4 + shift) + (shift > 0)}]
          .push_back(static_cast<std::uint32_t>(i));
    }
  }
  std::set<std::string> found;
  for (const auto& [key, members] : planes) {
    for (std::size_t i = 0; i < members.size(); ++i) {
      const auto a = flattened(triangles[members[i]], drops[members[i]]);
      for (std::size_t j = i + 1; j < members.size(); ++j) {
        const Triangle &s = triangles[members[i]], &t = triangles[members[j]];
        const auto b = flattened(t, drops[members[i]]);
        const DVec2 low = glm::max(glm::min(a[0], glm::min(a[1], a[2])), glm::min(b[0], glm::min(b[1], b[2])));
        const DVec2 high = glm::min(glm::max(a[0], glm::max(a[1], a[2])), glm::max(b[0], glm::max(b[1], b[2])));
        if (low.x >= high.x || low.y >= high.y || overlap_area({a.begin(), a.end()}, b) <= 1e-6) continue;
        found.insert(scene.nodes[s.node].name + " / " + scene.nodes[t.node].name);
      }
    }
  }
  return {found.begin(), found.end()};
}

std::size_t open_edges(const std::vector<Triangle>& triangles) {
  using Point = std::tuple<float, float, float>;
  std::map<std::pair<Point, Point>, int> balance;
  const auto key = [](const Vec3& p) { return Point(p.x, p.y, p.z); };
  for (const Triangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Point a = key(t.p[k]), b = key(t.p[(k + 1) % 3]);
      a < b ? ++balance[{a, b}] : --balance[{b, a}];
    }
  }
  std::size_t open = 0;
  for (const auto& [edge, count] : balance) open += static_cast<std::size_t>(std::abs(count));
  return open;
}

std::vector<Vec3> directions(int count) {
  std::vector<Vec3> all;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - 2 * (i + 0.5) / count, r = std::sqrt(1 - z * z), phi = i * 2.399963229728653;
    all.push_back(glm::normalize(Vec3(DVec3(r * std::cos(phi), z, r * std::sin(phi)))));
  }
  return all;
}

}  // namespace oriel::sample::testing
