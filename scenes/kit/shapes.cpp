#include "scenes/kit/shapes.h"

#include <algorithm>
#include <array>

namespace oriel::sample {
namespace {

std::uint32_t add_vertex(SampleMesh& mesh, const Vec3& position, const Vec3& normal) {
  mesh.positions.push_back(position);
  mesh.normals.push_back(normalize_or(normal, Vec3(0, 1, 0)));
  return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

void add_triangle(SampleMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  mesh.indices.insert(mesh.indices.end(), {a, b, c});
}

Vec3 triangle_normal(const Vec3& a, const Vec3& b, const Vec3& c) {
  return normalize_or(Vec3(glm::cross(DVec3(b) - DVec3(a), DVec3(c) - DVec3(a))), Vec3(0, 1, 0));
}

// Ring of a lathe: where its vertices start, and whether it is a single point on the axis.
struct Ring {
  std::uint32_t first = 0;
  bool pole = false;
};

Ring add_ring(SampleMesh& mesh, const Vec3& base, const Vec2& point, const Vec2& normal, int around) {
  Ring ring{static_cast<std::uint32_t>(mesh.positions.size()), point.x <= 0};
  if (ring.pole) {
    add_vertex(mesh, base + Vec3(0, point.y, 0), Vec3(0, normal.y < 0 ? -1 : 1, 0));
    return ring;
  }
  for (int i = 0; i < around; ++i) {
    const double phi = 2 * kPiD * i / around;
    const auto c = static_cast<float>(std::cos(phi)), s = static_cast<float>(std::sin(phi));
    add_vertex(mesh, base + Vec3(c * point.x, point.y, s * point.x), Vec3(c * normal.x, normal.y, s * normal.x));
  }
  return ring;
}

void join_rings(SampleMesh& mesh, const Ring& below, const Ring& above, int around) {
  for (int i = 0; i < around; ++i) {
    const auto here = static_cast<std::uint32_t>(i), next = static_cast<std::uint32_t>((i + 1) % around);
    const std::uint32_t a = below.pole ? below.first : below.first + here;
    const std::uint32_t b = below.pole ? below.first : below.first + next;
    const std::uint32_t c = above.pole ? above.first : above.first + next;
    const std::uint32_t d = above.pole ? above.first : above.first + here;
    if (!below.pole) add_triangle(mesh, a, c, b);
    if (!above.pole) add_triangle(mesh, a, d, c);
  }
}

}  // namespace

void add_quad(SampleMesh& mesh, const Quad& quad) {
  const auto& [origin, u, v] = quad;
  add_corners(mesh, origin, origin + u, origin + u + v, origin + v);
}

void add_corners(SampleMesh& mesh, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 first = triangle_normal(a, b, c), second = triangle_normal(a, c, d);
  const std::uint32_t i = add_vertex(mesh, a, first);
  add_vertex(mesh, b, first);
  add_vertex(mesh, c, first);
  add_triangle(mesh, i, i + 1, i + 2);
  if (glm::dot(first, second) > 0.9999999f) {
    add_triangle(mesh, i, i + 2, add_vertex(mesh, d, first));
    return;
  }
  const std::uint32_t j = add_vertex(mesh, a, second);
  add_vertex(mesh, c, second);
  add_vertex(mesh, d, second);
  add_triangle(mesh, j, j + 1, j + 2);
}

void place_quad(SampleScene& scene, std::string name, std::uint32_t material, const Quad& quad) {
  SampleMesh mesh{std::move(name), material};
  add_quad(mesh, quad);
  place(scene, std::move(mesh));
}

void add_quad_around(SampleMesh& mesh, const Quad& quad, const Hole& hole) {
  const auto& [low, high] = hole;
  const auto at = [&](float s, float t) { return quad.origin + s * quad.u + t * quad.v; };
  const std::array<Vec3, 4> outer{at(0, 0), at(1, 0), at(1, 1), at(0, 1)};
  const std::array<Vec3, 4> inner{at(low.x, low.y), at(high.x, low.y), at(high.x, high.y), at(low.x, high.y)};
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t next = (i + 1) % 4;
    add_corners(mesh, outer[i], outer[next], inner[next], inner[i]);
  }
}

void add_box(SampleMesh& mesh, const Vec3& lower, const Vec3& upper, unsigned faces) {
  const Vec3 size = upper - lower;
  const Vec3 x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
  if (faces & kLeft) add_quad(mesh, {lower, z, y});
  if (faces & kRight) add_quad(mesh, {lower + x + z, -z, y});
  if (faces & kBottom) add_quad(mesh, {lower, x, z});
  if (faces & kTop) add_quad(mesh, {lower + y + z, x, -z});
  if (faces & kBack) add_quad(mesh, {lower + x, -x, y});
  if (faces & kFront) add_quad(mesh, {lower + z, x, y});
}

void add_slab(SampleMesh& slab, SampleMesh& legs, const Vec3& lower, const Vec3& upper, float leg) {
  add_box(slab, lower, upper);
  for (const float x : {lower.x, upper.x - leg})
    for (const float z : {lower.z, upper.z - leg}) add_box(legs, {x, 0, z}, {x + leg, lower.y, z + leg}, kSides);
}

void add_rounded_box(SampleMesh& mesh, const Vec3& centre, const Vec3& size, float radius, int n) {
  const Vec3 half = 0.5f * size;
  if (n <= 1) {
    add_box(mesh, centre - half, centre + half);
    return;
  }
  const float r = std::min(radius, 0.999f * std::min({half.x, half.y, half.z}));
  const Vec3 core = half - Vec3(r);
  for (int axis = 0; axis < 3; ++axis) {
    for (int sign = -1; sign <= 1; sign += 2) {
      const int ua = (axis + (sign > 0 ? 1 : 2)) % 3, va = (axis + (sign > 0 ? 2 : 1)) % 3;
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i) {
          Vec3 p(0);
          p[axis] = static_cast<float>(sign) * half[axis];
          p[ua] = half[ua] * static_cast<float>(2.0 * i / n - 1.0);
          p[va] = half[va] * static_cast<float>(2.0 * j / n - 1.0);
          const Vec3 inner = glm::clamp(p, -core, core);
          const Vec3 normal = normalize_or(p - inner, Vec3(0, 1, 0));
          add_vertex(mesh, centre + inner + r * normal, normal);
        }
      }
      const auto row = static_cast<std::uint32_t>(n + 1);
      for (std::uint32_t j = 0; j + 1 < row; ++j) {
        for (std::uint32_t i = 0; i + 1 < row; ++i) {
          const std::uint32_t a = first + j * row + i;
          add_triangle(mesh, a, a + 1, a + row + 1);
          add_triangle(mesh, a, a + row + 1, a + row);
        }
      }
    }
  }
}

void add_lathe(SampleMesh& mesh, const Vec3& base, std::span<const Vec2> profile, int around) {
  if (profile.size() < 2) return;
  std::vector<Vec2> flat;  // by segment: the normal in the (radius, height) plane
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const DVec2 d = DVec2(profile[i + 1]) - DVec2(profile[i]);
    flat.push_back(Vec2(DVec2(d.y, -d.x) / glm::length(d)));
  }
  const float smooth_cos = std::cos(35.0f * kPi / 180.0f);
  Ring below = add_ring(mesh, base, profile[0], flat[0], around);
  for (std::size_t i = 0; i < flat.size(); ++i) {
    const bool last = i + 1 == flat.size();
    const bool smooth = !last && glm::dot(flat[i], flat[i + 1]) > smooth_cos;
    const Vec2 normal = smooth ? flat[i] + flat[i + 1] : flat[i];
    const Ring above = add_ring(mesh, base, profile[i + 1], normal, around);
    join_rings(mesh, below, above, around);
    below = smooth || last ? above : add_ring(mesh, base, profile[i + 1], flat[i + 1], around);
  }
}

void add_sphere(SampleMesh& mesh, const Vec3& centre, float radius, int around, int along) {
  std::vector<Vec2> profile(static_cast<std::size_t>(along) + 1);
  for (int i = 0; i <= along; ++i) {
    const double theta = kPiD * i / along;
    profile[static_cast<std::size_t>(i)] =
        Vec2(radius * static_cast<float>(std::sin(theta)), -radius * static_cast<float>(std::cos(theta)));
  }
  profile.front().x = profile.back().x = 0;
  add_lathe(mesh, centre, profile, around);
}

void add_fluted_shaft(SampleMesh& mesh, const Vec3& base, const FlutedShaft& shaft) {
  const auto row = static_cast<std::uint32_t>(shaft.segments + 1);
  for (int f = 0; f < shaft.flutes; ++f) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int k = 0; k <= shaft.rings; ++k) {
      const double t = static_cast<double>(k) / shaft.rings;
      // Entasis: the taper grows with height.
      const double radius = shaft.bottom_radius + (shaft.top_radius - shaft.bottom_radius) * (0.4 * t + 0.6 * t * t);
      const double slope = (shaft.top_radius - shaft.bottom_radius) * (0.4 + 1.2 * t) / shaft.height;
      for (int s = 0; s <= shaft.segments; ++s) {
        const double u = static_cast<double>(s) / shaft.segments;
        // The last vertex of the last flute is the first of the first: same numbers, so that the shaft is closed.
        const double phi = 2 * kPiD * (s == shaft.segments ? (f + 1) % shaft.flutes : f + u) / shaft.flutes;
        const double bow = s == shaft.segments ? 0 : 4 * u * (1 - u);
        const double r = radius - shaft.flute_depth * bow;
        const double dr = -shaft.flute_depth * 4 * (1 - 2 * u) * shaft.flutes / (2 * kPiD);  // by φ
        const double c = std::cos(phi), n = std::sin(phi);
        const Vec3 position = base + Vec3(DVec3(r * c, t * shaft.height, r * n));
        add_vertex(mesh, position, Vec3(DVec3(r * c + dr * n, -slope * r, r * n - dr * c)));
      }
    }
    for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(shaft.rings); ++k) {
      for (std::uint32_t s = 0; s + 1 < row; ++s) {
        const std::uint32_t a = first + k * row + s;
        add_triangle(mesh, a, a + row + 1, a + 1);
        add_triangle(mesh, a, a + row, a + row + 1);
      }
    }
  }
}

void add_frame(SampleMesh& mesh, const Vec2& size, float border, float depth, float sunk) {
  const Vec2 inner = 0.5f * size, outer = inner + Vec2(border);
  const std::array<Vec2, 4> corner{Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1)};
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2 here = corner[i], next = corner[(i + 1) % 4];
    const auto at = [](const Vec2& p, float z) { return Vec3(p, z); };
    add_corners(mesh, at(outer * here, depth), at(outer * next, depth), at(inner * next, depth),
                at(inner * here, depth));
    add_corners(mesh, at(outer * here, -sunk), at(outer * next, -sunk), at(outer * next, depth),
                at(outer * here, depth));
    add_corners(mesh, at(inner * here, depth), at(inner * next, depth), at(inner * next, 0), at(inner * here, 0));
  }
}

void project_uvs(SampleMesh& mesh, const Vec3& origin, const Vec3& u, const Vec3& v) {
  mesh.uvs.clear();
  for (const Vec3& p : mesh.positions) mesh.uvs.emplace_back(glm::dot(p - origin, u), glm::dot(p - origin, v));
}

}  // namespace oriel::sample
