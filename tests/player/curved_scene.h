// A room all around a ball, in closed form, and the ball as a pack with a surround map.
#pragma once

#include <functional>

#include "formats/core/octahedral.h"
#include "formats/query/camera.h"
#include "tests/player/frame_fixture.h"

namespace oriel::test {
// A room around a ball, all closed forms. Pack space.
inline constexpr Vec3 kLower{-2, 0, -2}, kUpper{2, 3, 2};

inline Vec3 exit_point(const Vec3& from, const Vec3& direction) {
  float t = 1e30f;
  for (int axis = 0; axis < 3; ++axis)
    if (direction[axis] != 0)
      t = std::min(t, ((direction[axis] > 0 ? kUpper : kLower)[axis] - from[axis]) / direction[axis]);
  return from + t * direction;
}

// Squares of half a metre, a colour a wall: the same within a square, so that a colour tells a place.
inline Vec3 wall_light(const Vec3& p) {
  int wall = 0;
  float least = 1e30f;
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      const float off = std::abs(p[axis] - (side ? kUpper : kLower)[axis]);
      if (off < least) {
        least = off;
        wall = 2 * axis + side;
      }
    }
  const glm::ivec3 square = glm::floor(2.0f * (p + 0.013f));  // no edge where walls meet
  const bool odd = ((square[(wall / 2 + 1) % 3] + square[(wall / 2 + 2) % 3]) & 1) != 0;
  const Vec3 hue(0.2f + 0.15f * static_cast<float>(wall), wall % 2 ? 0.9f : 0.3f, 1 - 0.15f * static_cast<float>(wall));
  return 100.0f * (odd ? hue : 0.4f * hue);
}

inline SurroundMap room_map(const Vec3& centre, std::uint32_t size,
                            const std::function<Vec3(const Vec3& place)>& light) {
  SurroundMap map;
  map.centre = centre;
  map.size = size;
  for (std::uint32_t y = 0; y < size; ++y)
    for (std::uint32_t x = 0; x < size; ++x) {
      const Vec2 at = (Vec2(x, y) + 0.5f) / static_cast<float>(size) * 2.0f - 1.0f;
      const Vec3 p = exit_point(centre, glm::normalize(direction_from_octahedral(at)));
      map.radiance.push_back(light(p));
      map.inverse_distance.push_back(1 / glm::length(p - centre));
      map.valid.push_back(1);
    }
  return map;
}

struct Ball {
  Vec3 centre{0.3f, 0.9f, 0.2f};
  float radius = 0.5f;
};

// A polished ball in the room, nothing else; `around` and `along` faces.
inline Pack ball_pack(const Ball& ball, const SurroundMap& map, int around = 192, int along = 96) {
  Pack pack;
  Material metal;
  metal.fresnel_map = 0;
  metal.kernel = 0;
  metal.metallic = 1;
  pack.materials = {metal};
  pack.kernels.emplace_back();
  pack.kernels[0].weights = {1};
  pack.fresnel_maps = {testing::flat_reflectance(Vec3(1))};
  for (int j = 0; j <= along; ++j)
    for (int i = 0; i < around; ++i) {
      const float theta = kPi * static_cast<float>(j) / static_cast<float>(along);
      const float phi = 2 * kPi * static_cast<float>(i) / static_cast<float>(around);
      const Vec3 n(std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi));
      pack.mesh.positions.push_back(ball.centre + ball.radius * n);
      pack.mesh.normals.push_back(n);
      pack.mesh.uvs.emplace_back(0);
      pack.mesh.lightmap_uvs.emplace_back(0);
      if (j == along) continue;
      const auto at = [&](int x, int y) { return static_cast<std::uint32_t>(y * around + x % around); };
      for (const std::uint32_t v : {at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i + 1, j)})
        pack.mesh.indices.push_back(v);
    }
  MeshPart part;
  part.index_count = static_cast<std::uint32_t>(pack.mesh.indices.size());
  pack.mesh.parts = {part};
  pack.surround_maps = {map};
  pack.curved_reflectors = {{"ball", 0, 0, pack.mesh.indices}};
  return pack;
}

inline Camera looking_at(const Vec3& eye, const Vec3& target) {
  return look_at(eye, target, 0.7f);
}

}  // namespace oriel::test
