// A square lamp over movers and a floor, and by rays what it gives the floor.
#pragma once

#include "formats/query/mover_pose.h"
#include "tests/player/mover_fixture.h"

namespace oriel::testing {

inline constexpr float kLampRadiance = 100;
inline constexpr int kLampCells = 96;  // of the rays' lamp, along a side

// The lamp is a square of 1 m in the plane y = 2, the floor lies at y = -2.
inline Pack lamp_scene() {
  Pack pack = shadow_scene();
  BrightLight& lamp = pack.light_field.lights[0];
  lamp.kind = BrightLightKind::kPolygon;
  lamp.intensity = Vec3(kLampRadiance);
  lamp.direction = {0, -1, 0};
  lamp.corners = {{-0.5f, 2, -0.5f}, {0.5f, 2, -0.5f}, {0.5f, 2, 0.5f},
                  {-0.5f, 2, -0.5f}, {0.5f, 2, 0.5f},  {-0.5f, 2, 0.5f}};
  return pack;
}

inline bool meets(const DVec3& from, const DVec3& to, const DVec3& a, const DVec3& b, const DVec3& c) {
  const DVec3 way = to - from, n = glm::cross(b - a, c - a);
  const double along = glm::dot(way, n);
  if (along == 0) return false;
  const double t = glm::dot(a - from, n) / along;
  if (!(t > 1e-9 && t < 1 - 1e-9)) return false;
  const DVec3 p = from + t * way;
  return glm::dot(glm::cross(b - a, p - a), n) >= 0 && glm::dot(glm::cross(c - b, p - b), n) >= 0 &&
         glm::dot(glm::cross(a - c, p - c), n) >= 0;
}

inline bool meets(const DVec3& from, const DVec3& to, const Mesh& mesh, const DMat4& pose) {
  const auto at = [&](std::uint32_t i) { return DVec3(pose * DVec4(DVec3(mesh.positions[mesh.indices[i]]), 1)); };
  for (std::uint32_t i = 0; i + 2 < mesh.indices.size(); i += 3)
    if (meets(from, to, at(i), at(i + 1), at(i + 2))) return true;
  return false;
}

// What the lamp gives a point of the floor that nothing shades, and what movers alone take of it.
struct Lit {
  double open = 0, taken = 0;
};
inline Lit by_rays(const Pack& pack, std::span<const MoverPose> poses, const DVec3& p) {
  Lit lit;
  for (int i = 0; i < kLampCells; ++i)
    for (int j = 0; j < kLampCells; ++j) {
      const DVec3 q((i + 0.5) / kLampCells - 0.5, 2, (j + 0.5) / kLampCells - 0.5), way = q - p;
      const double r2 = glm::dot(way, way),
                   e = double{kLampRadiance} * way.y * way.y / (r2 * r2) / (kLampCells * kLampCells);
      lit.open += e;
      if (meets(p, q, pack.mesh, DMat4(1))) continue;
      bool blocked = false;
      for (std::size_t m = 0; m < pack.movers.size(); ++m)
        blocked = blocked || meets(p, q, pack.movers[m].mesh, pack_from_object(poses[m]));
      if (blocked) lit.taken += e;
    }
  return lit;
}

}  // namespace oriel::testing
