#include "tests/player/twins/surround_march.h"

#include <algorithm>
#include <optional>

#include "formats/core/octahedral.h"

namespace oriel {
namespace {

// Inverse distances of a direction: between texels, and of the nearest one.
struct Distances {
  float filtered, nearest;
};

Distances distance_at(const SurroundPyramid& map, const Vec3& direction) {
  const int width = map.size + 2;
  const Vec2 at = 1.0f + (0.5f * octahedral_from_direction(direction) + 0.5f) * static_cast<float>(map.size);
  const auto texel = [&](int x, int y) {
    return map
        .inverse_distance[static_cast<std::size_t>(std::clamp(y, 0, width - 1) * width + std::clamp(x, 0, width - 1))];
  };
  const Vec2 low = glm::floor(at - 0.5f), share = at - 0.5f - low;
  const int x = static_cast<int>(low.x), y = static_cast<int>(low.y);
  return {glm::mix(glm::mix(texel(x, y), texel(x + 1, y), share.x),
                   glm::mix(texel(x, y + 1), texel(x + 1, y + 1), share.x), share.y),
          texel(static_cast<int>(at.x), static_cast<int>(at.y))};
}

// A ray by the angle to its direction.
class Arc {
 public:
  Arc(const SurroundPyramid& map, const Vec3& side, const Vec3& direction, float h, float along)
      : map_(map), side_(side), direction_(direction), h_(h), along_(along) {}

  SurroundHit point(float angle) const {
    return {way(angle), 1 / std::max(h_ * std::cos(angle) / std::sin(angle) - along_, 1e-6f * h_)};
  }
  // How far the ray lies before the surface: h over its distance minus h over the surface's.
  float before(float angle) const { return std::sin(angle) - distance_at(map_, way(angle)).filtered * h_; }
  bool meets(float angle) const {
    const float surface = distance_at(map_, way(angle)).nearest * h_;
    return std::abs(surface - std::sin(angle)) <= kSurroundThickness * std::sin(angle);
  }

  // Between low, before the surface, and high, behind it: halved, then by false position. Both close in.
  float crossing(float& low, float& high) const {
    for (int k = 0; k < kSurroundHalvings; ++k) {
      const float middle = 0.5f * (low + high);
      (before(middle) <= 0 ? high : low) = middle;
    }
    const float over = before(low), under = -before(high);
    return over + under > 0 ? glm::mix(low, high, std::clamp(over / (over + under), 0.0f, 1.0f)) : high;
  }

 private:
  Vec3 way(float angle) const { return std::cos(angle) * direction_ + std::sin(angle) * side_; }

  const SurroundPyramid& map_;
  Vec3 side_, direction_;
  float h_, along_;
};

}  // namespace

SurroundHit march_surroundings(const SurroundPyramid& map, const Vec3& origin, const Vec3& direction) {
  const float along = glm::dot(origin, direction);
  const Vec3 nearest = origin - along * direction;
  const float h = glm::length(nearest), from_centre = glm::length(origin);
  if (h > 1e-5f * from_centre) {
    const Arc arc(map, nearest / h, direction, h, along);
    std::optional<SurroundHit> beside;  // where the ray was hidden last
    float begin = std::atan2(h, along);
    if (from_centre * map.range.x < 1) begin = std::min(begin, std::asin(std::min(h * map.range.x, 1.0f)));
    const float end = std::asin(std::min(h * map.range.y, 1.0f));
    const int steps =
        std::clamp(static_cast<int>(std::ceil((begin - end) * 0.5f * static_cast<float>(map.size))), 1, kSurroundSteps);
    float last = begin;
    bool in_front = arc.before(begin) >= -kSurroundThickness * std::sin(begin);
    for (int i = 1; i <= steps && begin > end; ++i) {
      const float at = glm::mix(begin, end, static_cast<float>(i) / static_cast<float>(steps));
      const bool behind = arc.before(at) <= 0;
      if (in_front && behind) {
        float low = last, high = at;
        const float hit = arc.crossing(low, high);
        if (arc.meets(hit)) return arc.point(hit);
        beside = arc.point(std::min(low + kSurroundBeside / static_cast<float>(map.size), begin));
        in_front = false;
      } else if (!behind) {
        in_front = true;
      }
      last = at;
    }
    if (!in_front && beside) return *beside;
  }
  const float w = distance_at(map, direction).nearest;
  return {direction, w > 0 ? 1 / std::max(1 / w - along, 1e-3f / w) : 0};
}

}  // namespace oriel
