// Small scenes built in memory for tests.
#pragma once

#include <functional>

#include "bake/scene/scene.h"

namespace oriel::test {

// Adds one surface at a time; finish() fills in bounds (but does not recentre).
class SceneParts {
 public:
  // A material that reflects diffusely only.
  std::uint32_t diffuse(const Vec3& albedo, const Vec3& emission = Vec3(0));
  std::uint32_t add(const SceneMaterial& material);

  // Gives a material a normal map of size x size texels: normal(x, y) of texel centres in [0,1]², any length, x along
  // u, y along -v of a quad's coordinates, z outwards.
  void normal_map(std::uint32_t material, std::uint32_t size, const std::function<Vec3(float u, float v)>& normal);

  // Parallelogram o, o+u, o+u+v, o+v; front = u × v. uv0 and uv1 = (s, t) along (u, v).
  void quad(const std::string& name, std::uint32_t material, const Vec3& o, const Vec3& u, const Vec3& v);
  // Axis-aligned box; front outwards, or inwards (a room).
  void box(const std::string& name, std::uint32_t material, const Vec3& lower, const Vec3& upper, bool inwards = false);
  // Icosphere with 20 * 4^levels faces, smooth normals.
  void sphere(const std::string& name, std::uint32_t material, const Vec3& centre, float radius, int levels,
              bool inwards = false);
  void mesh(const std::string& name, std::uint32_t material, const std::vector<Vec3>& positions,
            const std::vector<Vec3>& normals, const std::vector<UVec3>& triangles);

  Scene& scene() { return scene_; }
  Scene finish();

 private:
  Scene scene_;
};

}  // namespace oriel::test
