#include "player/movers/shadow_shaft.h"

namespace oriel {

constexpr float kWidest = 4;       // tangent: of a light inside the sphere
constexpr float kNearest = 0.01f;  // share of the distance where maps begin: lamps do not shade themselves
constexpr float kMargin = 1.01f;   // of the range beyond the sphere

Shaft make_shaft(const Vec4& at, const Vec4& sphere) {
  Shaft s;
  s.parallel = at.w == 0;
  const Vec3 center(sphere), to = s.parallel ? -Vec3(at) : center - Vec3(at);
  const float distance2 = std::max(length2(to), 1e-12f);
  s.frame = frame_from_normal(to / std::sqrt(distance2));
  s.from = s.parallel ? center : Vec3(at);
  s.tangent = s.parallel ? sphere.w
                         : std::min(sphere.w / std::sqrt(std::max(distance2 - sphere.w * sphere.w, 1e-12f)), kWidest);
  s.distance = s.parallel ? 0 : std::sqrt(distance2);
  return s;
}

Vec2 mover_range(const Shaft& shaft, float radius) {
  const float reach = std::max(kMargin * radius, 1e-6f);
  if (shaft.parallel) return {-reach, reach};
  return {std::max(shaft.distance - reach, kNearest * shaft.distance), shaft.distance + reach};
}

Vec2 scene_range(const Shaft& shaft, float reach) {
  if (shaft.parallel) return {-reach, reach};
  return {kNearest * shaft.distance, shaft.distance + reach};
}

Mat4 clip_from_pack(const Shaft& shaft, const Vec2& range) {
  const Mat3 rows = glm::transpose(shaft.frame);
  Mat4 local(rows);
  local[3] = Vec4(-(rows * shaft.from), 1);
  const float length = range.y - range.x, width = 1 / std::max(shaft.tangent, 1e-12f);
  Mat4 clip(0);
  clip[0][0] = clip[1][1] = width;
  if (shaft.parallel) {
    clip[2][2] = 2 / length;
    clip[3][2] = -(range.y + range.x) / length;
    clip[3][3] = 1;
  } else {
    clip[2][2] = (range.y + range.x) / length;
    clip[3][2] = -2 * range.y * range.x / length;
    clip[2][3] = 1;
  }
  return clip * local;
}

}  // namespace oriel
