#include "tests/player/twins/march.h"

namespace oriel {
namespace {

IVec2 map_texel(const MapRay& ray, float at, const IVec2& size) {
  return glm::clamp(IVec2(glm::floor(ray.from + at * ray.direction)), IVec2(0), size - 1);
}

// The first border between texels more than a little after `at`.
float next_border(const MapRay& ray, float at) {
  const Vec2 from = glm::sign(ray.direction) * (ray.from + at * ray.direction);
  const Vec2 inside = glm::fract(from + kBorder) - kBorder;
  const Vec2 steps = (1.0f - inside) / glm::max(glm::abs(ray.direction), 1e-6f);
  return at + std::min(steps.x, steps.y);
}

// Disparity, bilinear.
float disparity_at(const Relief& relief, const Vec2& at) {
  const Vec2 inside = glm::clamp(at, Vec2(0.5f), Vec2(relief.size) - 0.5f) - 0.5f;
  const IVec2 low(glm::floor(inside)), high = glm::min(low + 1, relief.size - 1);
  const Vec2 t = inside - Vec2(low);
  return glm::mix(glm::mix(relief.at(low), relief.at({high.x, low.y}), t.x),
                  glm::mix(relief.at({low.x, high.y}), relief.at(high), t.x), t.y);
}

// The same over the surface around a texel of it.
float on_surface(float s, float surface) {
  return std::clamp(s, surface / (1 + kNear), surface * (1 + kNear));
}

// Whether a texel of disparity `surface` goes on the surface at `begin`, in the texel before it: both are on one plane
// by the slopes before and behind, or those planes meet between them.
bool is_connected(const Relief& relief, const MapRay& ray, float begin, const IVec2& texel, float surface) {
  const IVec2 beside = map_texel(ray, begin, relief.size), way = texel - beside;
  const float last = relief.at(beside);
  const float earlier = relief.at(glm::clamp(beside - way, IVec2(0), relief.size - 1));
  const float after = relief.at(glm::clamp(texel + way, IVec2(0), relief.size - 1));
  const auto unit = static_cast<float>(std::max(relief.size.x, relief.size.y));
  const float first = unit * (last - (surface - (after - surface)));
  const float second = unit * (last + (last - earlier) - surface);
  const float least = std::min(std::fabs(first), std::fabs(second));
  const float most = std::max(std::fabs(first), std::fabs(second));
  const bool meet = (first <= 0) != (second <= 0) || least <= kGap;
  return surface <= 1 && last <= 1 && (most <= kGap || (meet && unit * std::fabs(surface - last) <= kSteep));
}

// The crossing in [begin, end], found by false position.
float refine_crossing(const Relief& relief, const MapRay& ray, float begin, float end, float surface) {
  const auto height = [&](float at) {
    return ray.disparity(at) - on_surface(disparity_at(relief, ray.from + at * ray.direction), surface);
  };
  float above = height(begin), below = height(end);
  for (int i = 0; i < 2; ++i) {
    if (above <= 0) return begin;
    if (below >= 0) return end;
    const float middle = glm::mix(begin, end, above / (above - below));
    const float left = height(middle);
    (left > 0 ? begin : end) = middle;
    (left > 0 ? above : below) = left;
  }
  return above - below > 0 ? glm::mix(begin, end, std::clamp(above / (above - below), 0.0f, 1.0f)) : begin;
}

}  // namespace

MapRay map_ray(const Vec3& eye, const Vec2& lower, const Vec2& upper, const IVec2& size, const Vec2& on_plane,
               const Vec3& direction) {
  const Vec2 to_pixels = Vec2(size) / (upper - lower);
  const Vec2 start = (on_plane - lower) * to_pixels;
  // To where it goes at infinity.
  const Vec2 way = (Vec2(eye) - eye.z * Vec2(direction) / direction.z - lower) * to_pixels - start;
  const Vec2 safe(std::fabs(way.x) < 1e-12f ? 1e-12f : way.x, std::fabs(way.y) < 1e-12f ? 1e-12f : way.y);
  const Vec2 a = -start / safe, b = (Vec2(size) - start) / safe;
  const Vec2 first = glm::min(a, b), last = glm::max(a, b);
  const float enter = std::max({first.x, first.y, 0.0f}), leave = std::min({last.x, last.y, 1.0f});
  MapRay ray;
  if (!(enter <= leave)) return ray;
  const Vec2 inside = (leave - enter) * way;
  ray.length = std::max({std::fabs(inside.x), std::fabs(inside.y), 1e-3f});
  ray.from = start + enter * way;
  ray.direction = inside / ray.length;
  ray.s_begin = 1 - enter;
  ray.s_end = 1 - leave;
  ray.fall = (leave - enter) / ray.length;
  ray.hidden = enter * std::max(std::fabs(way.x), std::fabs(way.y));
  return ray;
}

MapHit march(const Relief& relief, const MapRay& ray) {
  if (ray.length < 0) return {};
  float at = 0, s = ray.s_begin, hidden = ray.hidden, surface = -1;
  bool before = relief.at(map_texel(ray, 0, relief.size)) <= s * (1 + kTouching);
  int level = std::clamp(static_cast<int>(std::ceil(std::log2(ray.length))), 1, kRangeLevels);
  IVec2 texel{0};
  bool hit = false;
  for (int step = 0; step < kMaxMarchSteps && at < ray.length; ++step) {
    const float next = std::min(level > 0 ? at + static_cast<float>(1 << level) : next_border(ray, at), ray.length);
    const float s_next = ray.disparity(next);
    if (level > 0) {
      texel = map_texel(ray, 0.5f * (at + next), relief.size);
      const Vec2 range = relief.range(level, {texel.x >> level, texel.y >> level});
      if (before ? range.y < s_next : range.x > s) {
        hidden += before ? 0 : next - at;
        at = next;
        s = s_next;
        level = std::min(level + 1, kRangeLevels);
      } else {
        if (before && range.y < s) {
          at = std::clamp((ray.s_end - range.y) / ray.fall + ray.length, at, std::max(at, next - 0.5f));
          s = ray.disparity(at);
        }
        --level;
      }
      continue;
    }
    texel = map_texel(ray, 0.5f * (at + next), relief.size);
    surface = relief.at(texel);
    // It comes out behind an edge, or through the back of a surface, which it does not meet again at once.
    if (!before)
      before = surface < s_next || (surface < s && !is_connected(relief, ray, at - 2 * kBorder, texel, surface));
    if (before && surface >= s_next) {
      hit = surface <= s * (1 + kTouching) || is_connected(relief, ray, at - 2 * kBorder, texel, surface);
      if (hit) break;
      before = false;
    }
    hidden += before ? 0 : next - at;
    at = next;
    s = s_next;
    level = 1;
  }
  if (!hit) return {};
  const float crossing =
      refine_crossing(relief, ray, std::max(at - 0.5f, 0.0f), std::min(at + 1.5f, ray.length), surface);
  const float trust = 1 / (1 + kDistrust * hidden / static_cast<float>(std::max(relief.size.x, relief.size.y)));
  const Vec2 place = ray.from + crossing * ray.direction;
  const float s_mixed = disparity_at(relief, place);
  // Beside another surface its own texel tells, so that nothing of the other is mixed in.
  if (std::fabs(s_mixed - surface) > kMixed * surface)
    return {Vec2(texel) + 0.5f, std::clamp(surface, ray.disparity(std::min(at + 1, ray.length)), s), trust};
  return {place, ray.disparity(crossing), trust};
}

}  // namespace oriel
