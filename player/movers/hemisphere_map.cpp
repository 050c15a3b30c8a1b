#include "player/movers/hemisphere_map.h"

#include <array>

namespace oriel {
namespace {

constexpr float kNearestSeen = 2e-4f;  // over the size of what is seen

}  // namespace

Vec3 HemisphereMap::local(const Vec3& point) const {
  const Vec3 p = glm::transpose(frame) * (point - from);
  return {p.x, p.y, squeeze * p.z};
}

HemisphereMap hemisphere_of(const LiveLight& light, const Bounds& bounds) {
  HemisphereMap map;
  map.from = light.position;
  const Vec3 to_middle = bounds.center() - light.position;
  const float radius = std::max(bounds.radius(), 1e-6f), distance = glm::length(to_middle);
  const bool far = light.normal == Vec3(0);
  map.frame = frame_from_normal(far ? normalize_or(to_middle, Vec3(0, 0, 1)) : light.normal);
  // |x| + |y| <= √2 radius, and z >= distance - radius: the scene fills most of the square.
  if (far && distance > radius) map.squeeze = radius / distance;
  map.farthest = 2 * (map.squeeze * (distance + radius) + radius);
  map.nearest = far ? 0.5f * map.squeeze * std::max(distance - radius, radius) : kNearestSeen * 2 * radius;
  return map;
}

Vec3 hemisphere_ray(const HemisphereMap& map, const Vec2& place) {
  const Vec2 p(0.5f * (place.x + place.y), 0.5f * (place.x - place.y));
  return map.frame * Vec3(p, std::max(1 - std::abs(p.x) - std::abs(p.y), 0.0f) / map.squeeze);
}

float hemisphere_depth(const HemisphereMap& map, float height) {
  if (!(height > map.nearest)) return 0;
  if (!std::isfinite(height)) return 1;
  return std::min(map.farthest / (map.farthest - map.nearest) * (1 - map.nearest / height), 1.0f);
}

Vec2 face_signs(int face) {
  return {(face & 1) == 0 ? 1 : -1, (face & 2) == 0 ? 1 : -1};
}

Mat4 clip_from_pack(const HemisphereMap& map, int face) {
  const Vec2 sign = face_signs(face);
  const float scale = map.farthest / (map.farthest - map.nearest);
  // Rows over (x, y, z, 1) of local coordinates.
  const Vec4 height(sign, 1, 0), depth = (2 * scale - 1) * height - Vec4(0, 0, 0, 2 * scale * map.nearest);
  const Mat4 clip_from_local = glm::transpose(Mat4(Vec4(1, 1, 0, 0), Vec4(1, -1, 0, 0), depth, height));
  Mat4 local_from_pack(glm::transpose(map.frame));
  for (int column = 0; column < 3; ++column) local_from_pack[column].z *= map.squeeze;
  local_from_pack[3] = Vec4(map.local(Vec3(0)), 1);
  return clip_from_local * local_from_pack;
}

bool may_touch_face(const HemisphereMap& map, int face, const Vec4& sphere) {
  const Vec3 p = map.local(Vec3(sphere));
  const Vec2 sign = face_signs(face);
  return sign.x * p.x >= -sphere.w && sign.y * p.y >= -sphere.w && p.z >= -sphere.w * map.squeeze;
}

std::optional<HemispherePart> part_of_box(const HemisphereMap& map, const Bounds& box) {
  std::array<Vec3, 8> corners;
  for (int i = 0; i < 8; ++i)
    corners[static_cast<std::size_t>(i)] = map.local(glm::mix(box.lower, box.upper, Vec3(i & 1, i >> 1 & 1, i >> 2)));
  HemispherePart part;
  part.height = std::numeric_limits<float>::infinity();
  float nearest = std::numeric_limits<float>::infinity();
  Vec3 lower(std::numeric_limits<float>::infinity()), upper(-lower);
  const auto add = [&](const Vec3& p) {
    const Vec2 at = hemisphere_place(p);
    part.lower = glm::min(part.lower, at), part.upper = glm::max(part.upper, at);
    part.height = std::min(part.height, height_of(p));
  };
  for (const Vec3& corner : corners) {
    if (!(corner.z > 0)) return std::nullopt;
    add(corner);
    lower = glm::min(lower, corner), upper = glm::max(upper, corner), nearest = std::min(nearest, corner.z);
  }
  // Within a face both are those of corners. Where edges go from face to face they bend.
  for (std::size_t i = 0; i < 8; ++i)
    for (const std::size_t bit : {1u, 2u, 4u}) {
      if ((i & bit) != 0) continue;
      const Vec3 &a = corners[i], &b = corners[i | bit];
      for (int axis = 0; axis < 2; ++axis)
        if ((a[axis] < 0) != (b[axis] < 0)) add(glm::mix(a, b, a[axis] / (a[axis] - b[axis])));
    }
  if (lower.x < 0 && upper.x > 0 && lower.y < 0 && upper.y > 0) add(Vec3(0, 0, nearest));
  return part;
}

}  // namespace oriel
