// Small scenes made in memory.
#pragma once

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "bake/scene/scene.h"

namespace oriel::shapes {

inline Scene empty_scene() {
  Scene scene;
  scene.materials.emplace_back();
  return scene;
}

inline void update_bounds(Scene& scene) {
  scene.lower = Vec3(1e30f), scene.upper = Vec3(-1e30f);
  for (const Vec3& p : scene.positions) scene.lower = glm::min(scene.lower, p), scene.upper = glm::max(scene.upper, p);
}

// Appends a surface; triangles index `positions`.
inline Surface& add(Scene& scene, const std::string& name, const std::vector<Vec3>& positions,
                    const std::vector<UVec3>& triangles, const std::vector<Vec2>& uv1 = {}) {
  Surface surface;
  surface.name = name;
  surface.mesh_name = name + "-mesh";
  surface.first_triangle = static_cast<std::uint32_t>(scene.triangles.size());
  surface.triangle_count = static_cast<std::uint32_t>(triangles.size());
  surface.first_vertex = static_cast<std::uint32_t>(scene.positions.size());
  surface.vertex_count = static_cast<std::uint32_t>(positions.size());
  surface.has_uv1 = !uv1.empty();
  for (std::size_t i = 0; i < positions.size(); ++i) {
    scene.positions.push_back(positions[i]);
    scene.normals.push_back(Vec3(0, 1, 0));
    scene.uv0.push_back(Vec2(0));
    scene.uv1.push_back(uv1.empty() ? Vec2(0) : uv1[i]);
  }
  for (const UVec3& t : triangles) {
    scene.triangles.push_back(t + UVec3(surface.first_vertex));
    scene.triangle_surface.push_back(static_cast<std::uint32_t>(scene.surfaces.size()));
  }
  scene.surfaces.push_back(surface);
  update_bounds(scene);
  return scene.surfaces.back();
}

// Corner and two sides; front along cross(x, y). Its coordinates are [lower, upper] of the page where given.
inline Surface& add_quad(Scene& scene, const std::string& name, const Vec3& corner, const Vec3& x, const Vec3& y) {
  return add(scene, name, {corner, corner + x, corner + x + y, corner + y}, {{0, 1, 2}, {0, 2, 3}});
}
inline Surface& add_quad_uv1(Scene& scene, const std::string& name, const Vec3& corner, const Vec3& x, const Vec3& y,
                             const Vec2& lower, const Vec2& upper) {
  return add(scene, name, {corner, corner + x, corner + x + y, corner + y}, {{0, 1, 2}, {0, 2, 3}},
             {lower, {upper.x, lower.y}, upper, {lower.x, upper.y}});
}

// Six sides with vertices of their own, faces outwards.
inline Surface& add_box(Scene& scene, const std::string& name, const Vec3& lower, const Vec3& size) {
  std::vector<Vec3> positions;
  std::vector<UVec3> triangles;
  for (int axis = 0; axis < 3; ++axis) {
    for (int sign = 0; sign < 2; ++sign) {
      Vec3 corner = lower, u(0), v(0);
      corner[axis] += sign ? size[axis] : 0;
      u[(axis + 1) % 3] = size[(axis + 1) % 3];
      v[(axis + 2) % 3] = size[(axis + 2) % 3];
      if (!sign) std::swap(u, v);
      const auto base = static_cast<std::uint32_t>(positions.size());
      positions.insert(positions.end(), {corner, corner + u, corner + u + v, corner + v});
      triangles.push_back({base, base + 1, base + 2});
      triangles.push_back({base, base + 2, base + 3});
    }
  }
  return add(scene, name, positions, triangles);
}

inline Surface& add_icosphere(Scene& scene, const std::string& name, float radius, int subdivisions) {
  const float g = (1 + std::sqrt(5.0f)) / 2;
  std::vector<Vec3> p{{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                      {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  std::vector<UVec3> t{{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                       {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                       {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int s = 0; s < subdivisions; ++s) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle;
    const auto mid = [&](std::uint32_t a, std::uint32_t b) {
      const auto [it, fresh] = middle.insert({{std::min(a, b), std::max(a, b)}, static_cast<std::uint32_t>(p.size())});
      if (fresh) p.push_back(glm::normalize(p[a]) + glm::normalize(p[b]));
      return it->second;
    };
    std::vector<UVec3> finer;
    for (const UVec3& f : t) {
      const std::uint32_t a = mid(f.x, f.y), b = mid(f.y, f.z), c = mid(f.z, f.x);
      finer.insert(finer.end(), {{f.x, a, c}, {f.y, b, a}, {f.z, c, b}, {a, b, c}});
    }
    t = std::move(finer);
  }
  for (Vec3& v : p) v = glm::normalize(v) * radius;
  return add(scene, name, p, t);
}

// The side of a cylinder along y, open at its ends.
inline Surface& add_cylinder(Scene& scene, const std::string& name, float radius, float height, std::uint32_t sides,
                             std::uint32_t rings = 1) {
  std::vector<Vec3> p;
  std::vector<UVec3> t;
  for (std::uint32_t r = 0; r <= rings; ++r)
    for (std::uint32_t i = 0; i < sides; ++i) {
      const float a = 2 * kPi * static_cast<float>(i) / static_cast<float>(sides);
      p.push_back(
          {radius * std::cos(a), height * static_cast<float>(r) / static_cast<float>(rings), -radius * std::sin(a)});
    }
  for (std::uint32_t r = 0; r < rings; ++r)
    for (std::uint32_t i = 0; i < sides; ++i) {
      const std::uint32_t a = r * sides + i, b = r * sides + (i + 1) % sides;
      t.push_back({a, b, b + sides});
      t.push_back({a, b + sides, a + sides});
    }
  return add(scene, name, p, t);
}

// A ramp that winds upwards `turns` times: each turn lies above the one before.
inline Surface& add_spiral(Scene& scene, const std::string& name, float inner, float outer, int turns,
                           int steps_a_turn) {
  std::vector<Vec3> p;
  std::vector<UVec3> t;
  for (int i = 0; i <= turns * steps_a_turn; ++i) {
    const float a = 2 * kPi * static_cast<float>(i) / static_cast<float>(steps_a_turn);
    const float y = 0.5f * static_cast<float>(i) / static_cast<float>(steps_a_turn);
    p.push_back({inner * std::cos(a), y, -inner * std::sin(a)});
    p.push_back({outer * std::cos(a), y, -outer * std::sin(a)});
    const auto b = static_cast<std::uint32_t>(2 * i);
    if (i > 0) t.push_back({b - 2, b - 1, b + 1}), t.push_back({b - 2, b + 1, b});
  }
  return add(scene, name, p, t);
}

inline double area_of(const Scene& scene) {
  double sum = 0;
  for (const UVec3& t : scene.triangles) {
    const DVec3 a(scene.positions[t.x]), b(scene.positions[t.y]), c(scene.positions[t.z]);
    sum += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  return sum;
}

}  // namespace oriel::shapes
