#include "tests/bake/support/scene_parts.h"

#include <fmt/format.h>

#include <map>

namespace oriel::test {

std::uint32_t SceneParts::add(const SceneMaterial& material) {
  scene_.materials.push_back(material);
  return static_cast<std::uint32_t>(scene_.materials.size() - 1);
}

std::uint32_t SceneParts::diffuse(const Vec3& albedo, const Vec3& emission) {
  SceneMaterial m;
  m.name = fmt::format("diffuse {}", scene_.materials.size());
  m.base_color = albedo;
  m.metallic = 0;
  m.specular = 0;
  m.emission = emission;
  return add(m);
}

void SceneParts::normal_map(std::uint32_t material, std::uint32_t size,
                            const std::function<Vec3(float u, float v)>& normal) {
  Image image;
  image.name = "normals";
  image.width = image.height = size;
  for (std::uint32_t y = 0; y < size; ++y)
    for (std::uint32_t x = 0; x < size; ++x) {
      const Vec2 uv = (Vec2(x, y) + 0.5f) / static_cast<float>(size);
      const Vec3 n = glm::normalize(normal(uv.x, uv.y));
      for (int c = 0; c < 3; ++c)
        image.texels.push_back(static_cast<std::uint8_t>(std::lround((n[c] * 0.5f + 0.5f) * 255)));
      image.texels.push_back(255);
    }
  scene_.materials[material].normal_texture.image = static_cast<std::int32_t>(scene_.images.size());
  scene_.images.push_back(std::move(image));
}

void SceneParts::mesh(const std::string& name, std::uint32_t material, const std::vector<Vec3>& positions,
                      const std::vector<Vec3>& normals, const std::vector<UVec3>& triangles) {
  Surface s;
  s.name = s.mesh_name = name;
  s.material = material;
  s.first_triangle = static_cast<std::uint32_t>(scene_.triangles.size());
  s.triangle_count = static_cast<std::uint32_t>(triangles.size());
  s.first_vertex = static_cast<std::uint32_t>(scene_.positions.size());
  s.vertex_count = static_cast<std::uint32_t>(positions.size());
  scene_.positions.insert(scene_.positions.end(), positions.begin(), positions.end());
  scene_.normals.insert(scene_.normals.end(), normals.begin(), normals.end());
  scene_.uv0.resize(scene_.positions.size());
  scene_.uv1.resize(scene_.positions.size());
  for (const UVec3& t : triangles) {
    scene_.triangles.push_back(t + s.first_vertex);
    scene_.triangle_surface.push_back(static_cast<std::uint32_t>(scene_.surfaces.size()));
  }
  scene_.surfaces.push_back(s);
}

void SceneParts::quad(const std::string& name, std::uint32_t material, const Vec3& o, const Vec3& u, const Vec3& v) {
  const Vec3 n = glm::normalize(glm::cross(u, v));
  mesh(name, material, {o, o + u, o + u + v, o + v}, {n, n, n, n}, {{0, 1, 2}, {0, 2, 3}});
  scene_.surfaces.back().has_uv1 = true;
  const std::uint32_t first = scene_.surfaces.back().first_vertex;
  const Vec2 corners[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (std::uint32_t i = 0; i < 4; ++i) scene_.uv0[first + i] = scene_.uv1[first + i] = corners[i];
}

void SceneParts::box(const std::string& name, std::uint32_t material, const Vec3& lower, const Vec3& upper,
                     bool inwards) {
  std::vector<Vec3> positions, normals;
  std::vector<UVec3> triangles;
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      const int a = (axis + 1) % 3, b = (axis + 2) % 3;
      Vec3 n(0);
      n[axis] = (side == 1) != inwards ? 1.0f : -1.0f;
      const auto first = static_cast<std::uint32_t>(positions.size());
      for (const auto& [i, j] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
        Vec3 p;
        p[axis] = side == 1 ? upper[axis] : lower[axis];
        p[a] = i == 1 ? upper[a] : lower[a];
        p[b] = j == 1 ? upper[b] : lower[b];
        positions.push_back(p);
        normals.push_back(n);
      }
      // (a, b, axis) is right-handed, so the order above is counter-clockwise seen from +axis.
      const bool flip = n[axis] < 0;
      triangles.push_back(flip ? UVec3(first, first + 2, first + 1) : UVec3(first, first + 1, first + 2));
      triangles.push_back(flip ? UVec3(first, first + 3, first + 2) : UVec3(first, first + 2, first + 3));
    }
  mesh(name, material, positions, normals, triangles);
}

void SceneParts::sphere(const std::string& name, std::uint32_t material, const Vec3& centre, float radius, int levels,
                        bool inwards) {
  const float g = 0.5f * (1 + std::sqrt(5.0f));
  std::vector<Vec3> points{{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                           {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  std::vector<UVec3> faces{{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                           {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                           {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (Vec3& p : points) p = glm::normalize(p);
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [at, added] =
          middles.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<std::uint32_t>(points.size()));
      if (added) points.push_back(glm::normalize(points[a] + points[b]));
      return at->second;
    };
    std::vector<UVec3> finer;
    for (const UVec3& f : faces) {
      const std::uint32_t a = middle(f.x, f.y), b = middle(f.y, f.z), c = middle(f.z, f.x);
      for (const UVec3& t : {UVec3(f.x, a, c), UVec3(f.y, b, a), UVec3(f.z, c, b), UVec3(a, b, c)}) finer.push_back(t);
    }
    faces = std::move(finer);
  }
  std::vector<Vec3> positions, normals;
  for (const Vec3& p : points) {
    positions.push_back(centre + radius * p);
    normals.push_back(inwards ? -p : p);
  }
  if (inwards)
    for (UVec3& f : faces) std::swap(f.y, f.z);
  mesh(name, material, positions, normals, faces);
}

Scene SceneParts::finish() {
  scene_.lower = Vec3(1e30f);
  scene_.upper = Vec3(-1e30f);
  for (const Vec3& p : scene_.positions) {
    scene_.lower = glm::min(scene_.lower, p);
    scene_.upper = glm::max(scene_.upper, p);
  }
  return scene_;
}

}  // namespace oriel::test
