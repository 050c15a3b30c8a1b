#include "bake/scene/scene.h"

namespace oriel {
namespace {

DVec3 doubled_area_vector(const Scene& scene, std::uint32_t triangle) {
  const UVec3& t = scene.triangles[triangle];
  const DVec3 a(scene.positions[t.x]);
  return glm::cross(DVec3(scene.positions[t.y]) - a, DVec3(scene.positions[t.z]) - a);
}

}  // namespace

Scene::Scene() = default;
Scene::~Scene() = default;
Scene::Scene(const Scene&) = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(const Scene&) = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

Vec3 geometric_normal(const Scene& scene, std::uint32_t triangle) {
  if (triangle < scene.face_normals.size()) return scene.face_normals[triangle];
  const DVec3 cross = doubled_area_vector(scene, triangle);
  return Vec3(cross / std::sqrt(glm::dot(cross, cross)));
}

void keep_face_normals(Scene& scene) {
  scene.face_normals.clear();
  std::vector<Vec3> normals;
  normals.reserve(scene.triangles.size());
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) normals.push_back(geometric_normal(scene, t));
  scene.face_normals = std::move(normals);
}

double triangle_area(const Scene& scene, std::uint32_t triangle) {
  const DVec3 cross = doubled_area_vector(scene, triangle);
  return 0.5 * std::sqrt(glm::dot(cross, cross));
}

}  // namespace oriel
