#include "scenes/kit/scene_builder.h"

#include <algorithm>

namespace oriel::sample {
std::uint32_t add_material(SampleScene& scene, SampleMaterial material) {
  scene.materials.push_back(std::move(material));
  return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

std::uint32_t add_mesh(SampleScene& scene, SampleMesh mesh) {
  scene.meshes.push_back(std::move(mesh));
  return static_cast<std::uint32_t>(scene.meshes.size() - 1);
}

void place(SampleScene& scene, SampleMesh mesh, const Vec3& position, float yaw_rad) {
  std::string name = mesh.name;
  const std::uint32_t index = add_mesh(scene, std::move(mesh));
  place(scene, index, std::move(name), position, yaw_rad);
}

void place(SampleScene& scene, std::uint32_t mesh, std::string name, const Vec3& position, float yaw_rad) {
  scene.nodes.push_back({std::move(name), mesh, position, yaw_rad});
}

std::uint32_t add_diffuse(SampleScene& scene, std::string name, const Vec3& color, const Vec3& emission) {
  return add_material(scene, {.name = std::move(name), .base_color = color, .emission = emission});
}

void scale_scene(SampleScene& scene, double factor) {
  const auto scale = [factor](Vec3& p) { p = Vec3(factor * DVec3(p)); };
  for (SampleMesh& mesh : scene.meshes)
    for (Vec3& p : mesh.positions) scale(p);
  for (Node& node : scene.nodes) scale(node.position);
  for (SampleMaterial& m : scene.materials)
    m.thickness_m *= static_cast<float>(factor), m.attenuation_distance_m *= static_cast<float>(factor);
  for (SampleCamera& camera : scene.cameras) {
    scale(camera.eye);
    scale(camera.target);
  }
  for (Path& path : scene.paths)
    for (Vec3& eye : path.eyes) scale(eye);
}

std::uint64_t triangle_count(const SampleScene& scene) {
  std::uint64_t count = 0;
  for (const Node& node : scene.nodes) count += scene.meshes[node.mesh].triangle_count();
  return count;
}

}  // namespace oriel::sample
