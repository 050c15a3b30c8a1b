#include "player/navigation/drag.h"

#include <algorithm>
#include <limits>

namespace oriel {
namespace {

constexpr float kNever = std::numeric_limits<float>::infinity();

float first_hit(const Mesh& mesh, const Vec3& from, const Vec3& direction) {
  const auto hit = first_triangle(mesh, from, direction);
  return hit ? hit->distance : kNever;
}

}  // namespace

PickRay ray_through(const View& view, const Vec2& place) {
  const Mat4 pack_from_clip = glm::inverse(view.clip_from_pack);
  const Vec2 at(2 * place.x - 1, 1 - 2 * place.y);
  const auto point = [&](float depth) {
    const Vec4 p = pack_from_clip * Vec4(at, depth, 1);
    return Vec3(p) / p.w;
  };
  const Vec3 near = point(-1);
  return {near, normalize_or(point(0) - near, Vec3(0, 0, -1))};
}

std::optional<Grip> grip_mover(const Pack& pack, std::span<const MoverPose> poses, const PickRay& ray) {
  float nearest = first_hit(pack.mesh, ray.from, ray.direction);
  std::optional<Grip> grip;
  for (std::size_t i = 0; i < std::min(poses.size(), pack.movers.size()); ++i) {
    const Mat4 object_from_pack(glm::inverse(pack_from_object(poses[i])));
    const Vec3 from(object_from_pack * Vec4(ray.from, 1)), direction(object_from_pack * Vec4(ray.direction, 0));
    const float distance = first_hit(pack.movers[i].mesh, from, direction);
    if (!(distance < nearest)) continue;
    nearest = distance;
    grip = Grip{i, ray.from + distance * ray.direction};
  }
  return grip;
}

std::optional<Grip> grip_lamp(const Pack& pack, std::span<const MoverPose> lamps, const PickRay& ray) {
  std::vector<std::size_t> group_of(pack.materials.size(), pack.light_groups.size());
  for (std::size_t g = 0; g < pack.light_groups.size(); ++g)
    for (const std::uint32_t m : pack.light_groups[g].materials) group_of[m] = g;
  float nearest = kNever;
  std::size_t of = pack.light_groups.size();
  for (const MeshPart& part : pack.mesh.parts) {
    const std::size_t group = group_of[part.material];
    const Mat4 lamp_from_pack = group < lamps.size() ? Mat4(glm::inverse(pack_from_object(lamps[group]))) : Mat4(1);
    const Vec3 from(lamp_from_pack * Vec4(ray.from, 1)), direction(lamp_from_pack * Vec4(ray.direction, 0));
    for (std::size_t i = part.first_index; i < std::size_t{part.first_index} + part.index_count; i += 3)
      if (const auto hit = meet_triangle(pack.mesh, i, from, direction); hit && hit->distance < nearest)
        nearest = hit->distance, of = group;
  }
  if (of == pack.light_groups.size()) return std::nullopt;
  return Grip{of, ray.from + nearest * ray.direction, true};
}

std::optional<Vec3> on_level(const PickRay& ray, float height, float farthest) {
  const float distance = (height - ray.from.y) / ray.direction.y;
  if (!(distance > 0 && distance <= farthest)) return std::nullopt;
  return ray.from + distance * ray.direction;
}

MoverMove& move_of(std::vector<MoverMove>& moves, const std::string& name, const DVec3& at) {
  const auto known = std::find_if(moves.rbegin(), moves.rend(), [&](const MoverMove& m) { return m.node == name; });
  if (known != moves.rend()) return *known;
  moves.push_back({name, at, 0});
  return moves.back();
}

}  // namespace oriel
