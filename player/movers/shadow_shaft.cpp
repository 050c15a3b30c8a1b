#include "player/movers/shadow_shaft.h"

#include <algorithm>

namespace oriel {

constexpr float kWidest = 4;             // tangent: of a light inside the sphere
constexpr float kNearestShadow = 0.01f;  // share of the distance where maps begin: lamps do not shade themselves
constexpr float kShadowMargin = 1.01f;   // of the range beyond the sphere

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
  const float reach = std::max(kShadowMargin * radius, 1e-6f);
  if (shaft.parallel) return {-reach, reach};
  return {std::max(shaft.distance - reach, kNearestShadow * shaft.distance), shaft.distance + reach};
}

Vec2 scene_range(const Shaft& shaft, float reach) {
  if (shaft.parallel) return {-reach, reach};
  return {kNearestShadow * shaft.distance, shaft.distance + reach};
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

Mat4 place_from_pack(const Shaft& shaft) {
  Mat4 place = clip_from_pack(shaft, {0, 1});
  const Vec3& along = shaft.frame[2];
  for (int axis = 0; axis < 3; ++axis) place[axis][2] = along[axis];
  place[3][2] = -glm::dot(along, shaft.from);
  return place;
}

Vec2 depth_terms(const Shaft& shaft, const Vec2& range) {
  const float length = range.y - range.x;
  if (shaft.parallel) return {-range.x / length, 1 / length};
  return {range.y / length, -range.x * range.y / length};
}

ShadowCone make_shadow_cone(const Vec4& sphere, const Vec3& center, float radius, bool parallel) {
  ShadowCone cone;
  cone.center = Vec3(sphere);
  cone.radius = kShadowMargin * sphere.w;
  const Vec3 to = parallel ? -center : cone.center - center;
  const float distance = glm::length(to);
  const float sine = parallel ? std::sin(std::atan(radius)) : (cone.radius + radius) / std::max(distance, 1e-12f);
  cone.everywhere = !(distance > 0 && sine < 1);
  if (cone.everywhere) return cone;
  const float cosine = std::sqrt(std::max(1 - sine * sine, 1e-6f));
  cone.frame = frame_from_normal(to / distance);
  cone.width = cone.radius / cosine;
  cone.slope = sine / cosine;
  return cone;
}

bool may_meet(const ShadowCone& cone, const Vec4& sphere) {
  const Vec3 off = (Vec3(sphere) - cone.center) * cone.frame;
  const float reach = cone.width + cone.slope * off.z + sphere.w * std::sqrt(1 + cone.slope * cone.slope);
  return cone.everywhere || (off.z > -cone.radius - sphere.w && glm::length(Vec2(off)) <= reach);
}

ShadowBox make_shadow_box(const ShadowCone& cone, const Bounds& bounds) {
  const auto box = [](const Mat3& frame, const Vec3& from, float from_half, const Vec3& to, float to_half) {
    ShadowBox out;
    for (std::size_t i = 0; i < 8; ++i) {
      const float half = (i & 4) != 0 ? to_half : from_half;
      out[i] = ((i & 4) != 0 ? to : from) + ((i & 1) != 0 ? half : -half) * frame[0] +
               ((i & 2) != 0 ? half : -half) * frame[1];
    }
    return out;
  };
  if (cone.everywhere) {
    const float all = bounds.radius() + glm::distance(bounds.center(), cone.center) + cone.radius;
    return box(Mat3(1), cone.center - Vec3(0, 0, all), all, cone.center + Vec3(0, 0, all), all);
  }
  // As far along as until all of the cone is beyond one of the planes.
  float end = 2 * bounds.radius() + glm::distance(cone.center, bounds.center());
  for (int axis = 0; axis < 3; ++axis) {
    const float way = cone.frame[2][axis], pace = std::abs(way) - cone.slope;
    const float left = way > 0 ? bounds.upper[axis] - cone.center[axis] : cone.center[axis] - bounds.lower[axis];
    if (pace > 0) end = std::min(end, std::max(cone.radius, (left + cone.width) / pace));
  }
  const auto half = [&](float t) { return std::max(cone.width + cone.slope * t, 0.0f); };
  const Vec3& along = cone.frame[2];
  return box(cone.frame, cone.center - cone.radius * along, half(-cone.radius), cone.center + end * along, half(end));
}

}  // namespace oriel
