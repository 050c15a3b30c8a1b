#include "player/movers/blocked_lights.h"

#include <numeric>
#include <utility>

#include "formats/core/check.h"

namespace oriel {
namespace {

constexpr float kRounding = 1e-5f;  // of the distance: more than sums of floats lose
constexpr Vec4 kNowhere{0, 0, 0, -1};

float cross(const Vec2& a, const Vec2& b) {
  return a.x * b.y - a.y * b.x;
}

// A rectangle as it is seen from the origin: the corners that are farthest clockwise and counter-clockwise.
struct Outline {
  Vec2 right, left;
};
Outline outline_of(const Vec2& lower, const Vec2& upper) {
  const bool x_above = lower.x > 0, x_below = upper.x<0, y_above = lower.y> 0, y_below = upper.y < 0;
  const float x_near = x_above ? lower.x : upper.x, y_near = y_above ? lower.y : upper.y;
  return {{y_above   ? upper.x
           : y_below ? lower.x
                     : x_near,
           x_above   ? lower.y
           : x_below ? upper.y
                     : y_near},
          {y_above   ? lower.x
           : y_below ? upper.x
                     : x_near,
           x_above   ? upper.y
           : x_below ? lower.y
                     : y_near}};
}

// Whether a circle lies wholly beside the hull of the origin and a rectangle, to one side.
bool lies_beside(const Vec2& lower, const Vec2& upper, const Vec2& center, float radius) {
  if (lower.x <= 0 && upper.x >= 0 && lower.y <= 0 && upper.y >= 0) return false;
  const Outline outline = outline_of(lower, upper);
  const float off_left = cross(outline.left, center), off_right = cross(center, outline.right);
  const float radius2 = radius * radius;
  return (off_left > 0 && off_left * off_left > radius2 * glm::dot(outline.left, outline.left)) ||
         (off_right > 0 && off_right * off_right > radius2 * glm::dot(outline.right, outline.right));
}

// A sphere from a light: widened by what rounding may take.
struct SeenSphere {
  Vec3 center{0};
  float radius = 0;
};

// Whether the sphere touches the pyramid of figure 4-5, the hull of light and box, as far as planes tell. The
// silhouette edges of a box are parallel to axes, so that the planes through them and the light are lines in the three
// views along axes. lower, upper: of the box, from the light.
bool touches_pyramid(const Vec3& lower, const Vec3& upper, const SeenSphere& s) {
  const Vec3 hull_lower = glm::min(lower, Vec3(0)), hull_upper = glm::max(upper, Vec3(0));
  const Vec3 off = glm::max(glm::max(hull_lower - s.center, s.center - hull_upper), Vec3(0));
  if (length2(off) > s.radius * s.radius) return false;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    if (lies_beside({lower[i], lower[j]}, {upper[i], upper[j]}, {s.center[i], s.center[j]}, s.radius)) return false;
  }
  return true;
}

// Whether some point of the box lies before a plane through the origin.
bool reaches_before(const Vec3& normal, const Vec3& middle, const Vec3& half) {
  const float reach = glm::dot(glm::abs(normal), half);
  return glm::dot(normal, middle) + reach + kRounding * (glm::length(middle) + reach) > 0;
}

// Whether some normal of the cone may face the light from some point of the box. The support of the box along any of
// the cone's normals n is that along its axis, and |n - axis| times half its diagonal at most.
bool may_face(const ShadeCell& cell, const Vec3& to_light, const Vec3& half) {
  const float cosine = cell.cos_spread;
  if (!(cosine > 0)) return true;
  const float distance = glm::length(to_light), along = glm::dot(cell.axis, to_light);
  const float across = std::sqrt(std::max(distance * distance - along * along, 0.0f));
  const float sine = std::sqrt(std::max(1 - cosine * cosine, 0.0f));
  const float towards = along >= cosine * distance ? distance : along * cosine + across * sine;
  const float radius = glm::length(half);
  const float reach = std::min(glm::dot(glm::abs(cell.axis), half) + std::sqrt(2 * (1 - cosine)) * radius, radius);
  return towards + reach + kRounding * (distance + radius) > 0;
}

bool faces(const ShadeCell& cell, const ShadeLight& light) {
  const Vec3 middle = cell.content.center() - light.position, half = 0.5f * (cell.content.upper - cell.content.lower);
  if (light.normal != Vec3(0) && !reaches_before(light.normal, middle, half)) return false;
  return may_face(cell, -middle, half);
}

SeenSphere seen_from(const ShadeLight& light, const Vec4& sphere) {
  const Vec3 center = Vec3(sphere) - light.position;
  return {center, sphere.w * (1 + kRounding) + kRounding * glm::length(center)};
}

}  // namespace

struct BlockedLights::Moving {
  std::uint64_t bit = 0;
  Bounds box;
  std::vector<SeenSphere> seen;  // by light
};

BlockedLights::BlockedLights(std::span<const ShadeCell> cells, std::span<const ShadeLight> lights, Hidden hidden)
    : cells_(cells.begin(), cells.end()),
      lights_(lights.begin(), lights.end()),
      hidden_(std::move(hidden)),
      movers_(cells.size() * lights.size(), 0),
      sight_(cells.size() * lights.size(), Sight::kUnknown),
      spheres_(kMostMovers, kNowhere) {}

void BlockedLights::move(std::uint32_t mover, const Vec4& sphere) {
  ORIEL_CHECK_LT(mover, kMostMovers);
  if (!(is_finite(Vec3(sphere)) && std::isfinite(sphere.w) && sphere.w >= 0)) return remove(mover);
  if (cells_.empty() || spheres_[mover] == sphere) return;
  spheres_[mover] = sphere;
  Moving moving{std::uint64_t{1} << mover, {Vec3(sphere) - sphere.w, Vec3(sphere) + sphere.w}, {}};
  for (const ShadeLight& light : lights_) moving.seen.push_back(seen_from(light, sphere));
  std::vector<std::uint32_t> all(lights_.size());
  std::iota(all.begin(), all.end(), 0u);
  visit(0, all, moving);
}

void BlockedLights::remove(std::uint32_t mover) {
  ORIEL_CHECK_LT(mover, kMostMovers);
  spheres_[mover] = kNowhere;
  if (cells_.empty()) return;
  for (std::uint32_t light = 0; light < lights_.size(); ++light) clear(0, light, std::uint64_t{1} << mover);
}

std::vector<std::uint32_t> BlockedLights::lights_of(std::uint32_t leaf) const {
  std::vector<std::uint32_t> out;
  for (std::uint32_t light = 0; light < lights_.size(); ++light)
    if (movers_[at(leaf, light)] != 0) out.push_back(light);
  return out;
}

// The state of the cell itself: the cells around it are partial.
bool BlockedLights::blocks(std::uint32_t index, std::uint32_t light, const Moving& moving) {
  const ShadeCell& cell = cells_[index];
  if (cell.content.empty()) return false;
  Sight& sight = sight_[at(index, light)];
  if (sight == Sight::kUnknown) sight = faces(cell, lights_[light]) ? Sight::kFacing : Sight::kClosed;
  if (sight == Sight::kClosed) return false;
  const Vec3& from = lights_[light].position;
  if (!touches_pyramid(cell.content.lower - from, cell.content.upper - from, moving.seen[light])) return false;
  if (sight == Sight::kFacing) sight = hides(light, cell.content) ? Sight::kClosed : Sight::kOpen;
  return sight == Sight::kOpen;
}

// The root's state: lights that the mover is wholly behind, or hidden from, are none of its.
bool BlockedLights::blocks_any(std::uint32_t light, const Moving& moving) {
  const Vec3& normal = lights_[light].normal;
  const SeenSphere& seen = moving.seen[light];
  if (normal != Vec3(0) && glm::dot(normal, seen.center) < -seen.radius) return false;
  return blocks(0, light, moving) && !hides(light, moving.box);
}

// Table 4-1. Where the mover blocks nothing now, it blocks nothing in the children either: no tests.
void BlockedLights::visit(std::uint32_t cell, std::span<const std::uint32_t> lights, const Moving& moving) {
  const std::uint32_t child = cells_[cell].child;
  std::vector<std::uint32_t> partial;
  for (const std::uint32_t light : lights) {
    const bool is = cell == 0 ? blocks_any(light, moving) : blocks(cell, light, moving);
    if (!is) {
      clear(cell, light, moving.bit);
      continue;
    }
    movers_[at(cell, light)] |= moving.bit;
    partial.push_back(light);
  }
  if (child == 0 || partial.empty()) return;
  visit(child, partial, moving);
  visit(child + 1, partial, moving);
}

void BlockedLights::clear(std::uint32_t cell, std::uint32_t light, std::uint64_t bit) {
  std::uint64_t& movers = movers_[at(cell, light)];
  if ((movers & bit) == 0) return;
  movers &= ~bit;
  const std::uint32_t child = cells_[cell].child;
  if (child == 0) return;
  clear(child, light, bit);
  clear(child + 1, light, bit);
}

}  // namespace oriel
