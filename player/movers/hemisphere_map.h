// What a light sees as a square: half of an octahedron around it, seen from above, turned so that it fills the square
// (Barczak 2006, section 4.2.1). Each of its four faces is a projective map: lines stay lines, so that triangles are
// drawn as they are, a face a pass. No OpenGL; the same maths as shaders/lib/shade.glsl.
#pragma once

#include "formats/query/live_lights.h"
#include "player/navigation/culling.h"

namespace oriel {

inline constexpr int kHemisphereFaces = 4;

// Coordinates of a light: p = transpose(frame) (point - from), along times `squeeze`. Its height is |x| + |y| + z,
// which grows along each ray as distance does.
struct HemisphereMap {
  Vec3 from{0};
  Mat3 frame{1};                        // across, up, along
  float squeeze = 1;                    // below 1: a map of less than the half space, for a light that is far away
  float nearest = 0.01f, farthest = 1;  // heights that its depths tell apart

  Vec3 local(const Vec3& point) const;
};

inline float height_of(const Vec3& local) {
  return std::abs(local.x) + std::abs(local.y) + local.z;
}

// bounds: of all that it may see. A light without normal is beyond them.
HemisphereMap hemisphere_of(const LiveLight& light, const Bounds& bounds);

// In [-1, 1]², of local coordinates whose z > 0.
inline Vec2 hemisphere_place(const Vec3& local) {
  return Vec2(local.x + local.y, local.x - local.y) / height_of(local);
}
// The ray there, of height 1: pack space.
Vec3 hemisphere_ray(const HemisphereMap& map, const Vec2& place);
// [0, 1], as a depth buffer holds it.
float hemisphere_depth(const HemisphereMap& map, float height);

// Draws onto a face: what lies in another one, by the signs of local x and y, is to be left out.
Mat4 clip_from_pack(const HemisphereMap& map, int face);
// Signs of x and y on a face.
Vec2 face_signs(int face);
bool may_touch_face(const HemisphereMap& map, int face, const Vec4& sphere);

// The part of a map that a box covers, and the least height of any of its points; nothing where it goes behind the
// light's plane.
struct HemispherePart {
  Vec2 lower{1}, upper{-1};
  float height = 0;
};
std::optional<HemispherePart> part_of_box(const HemisphereMap& map, const Bounds& box);

}  // namespace oriel
