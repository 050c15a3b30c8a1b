// What tests of glass are made of.
#pragma once

#include <cmath>

#include "tests/player/frame_fixture.h"

namespace oriel::testing {

// Material 0 is the glass; nothing reflects outside, so that what passes is all of the light.
inline Pack glass_pack(float ior, float roughness, const Vec3& absorption = Vec3(0)) {
  Pack pack;
  Material glass;
  glass.transmission = 1, glass.ior = ior, glass.roughness = roughness;
  pack.materials = {glass};
  pack.solids = {{0, Vec3(1), absorption}};
  return pack;
}

inline void add_box(Pack& pack, const Vec3& lower, const Vec3& upper, std::uint32_t material = 0) {
  const Vec3 x(upper.x - lower.x, 0, 0), y(0, upper.y - lower.y, 0), z(0, 0, upper.z - lower.z);
  add_quad(pack, lower, y, x, material, -1);
  add_quad(pack, lower + z, x, y, material, -1);
  add_quad(pack, lower, z, y, material, -1);
  add_quad(pack, lower + x, y, z, material, -1);
  add_quad(pack, lower, x, z, material, -1);
  add_quad(pack, lower + y, z, x, material, -1);
}

inline std::uint32_t add_lamp(Pack& pack, const Vec3& cd_m2) {
  Material lamp;
  lamp.base_color = Vec3(0);
  lamp.emission = cd_m2;
  pack.materials.push_back(lamp);
  return static_cast<std::uint32_t>(pack.materials.size() - 1);
}

inline Camera camera_at(const Vec3& eye, const Vec3& target, float fov = 0.8f) {
  Camera camera;
  camera.eye = eye;
  camera.forward = glm::normalize(target - eye);
  camera.vertical_fov_rad = fov;
  return camera;
}

inline Vec3 pixel_ray(const Camera& camera, int x, int y, int width, int height) {
  const Vec3 right = glm::normalize(glm::cross(camera.forward, Vec3(0, 1, 0))), up = glm::cross(right, camera.forward);
  const float half = std::tan(0.5f * camera.vertical_fov_rad);
  const float u = (2 * (static_cast<float>(x) + 0.5f) - static_cast<float>(width)) / static_cast<float>(height);
  const float v = 1 - 2 * (static_cast<float>(y) + 0.5f) / static_cast<float>(height);
  return glm::normalize(camera.forward + half * (u * right + v * up));
}

}  // namespace oriel::testing
