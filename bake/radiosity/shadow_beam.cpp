#include "bake/radiosity/shadow_beam.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace oriel {
namespace {

constexpr double kGrazing = 1e-4;  // sine of the least height of a sun over a surface that it lights

}  // namespace

ShadowBeam::ShadowBeam(const Light& light, const std::array<DVec3, 4>& corners, const DVec3& normal, double level)
    : corners_(corners),
      normal_(normal),
      middle_(0.25 * (corners[0] + corners[1] + corners[2] + corners[3])),
      lamp_(light.type == LightType::kDirectional ? -DVec3(light.direction) : DVec3(light.position)),
      sun_(light.type == LightType::kDirectional),
      tangent_(sun_ ? std::tan(double{light.angular_radius_rad}) : 0),
      level_(level),
      reach_(0.5 * std::max(glm::distance(corners[0], corners[2]), glm::distance(corners[1], corners[3]))),
      top_(sun_ ? std::numeric_limits<double>::infinity() : height(lamp_)) {
  faces_ = sun_ ? glm::dot(lamp_, normal_) > kGrazing - tangent_ : top_ > level_;
  for (std::size_t k = 0; k < 4; ++k) sides_[k] = side_through(corners_[k], corners_[(k + 1) % 4], middle_);
}

ShadowBeam::Side ShadowBeam::side_through(const DVec3& a, const DVec3& b, const DVec3& inside) const {
  const DVec3 across = glm::cross(b - a, sun_ ? lamp_ : lamp_ - a);
  const double size = glm::length(across);
  if (!(size > 1e-14 * glm::dot(b - a, b - a))) return {a, DVec3(0)};  // edge-on: it parts nothing
  const Side side{a, across / size};
  return side.beyond(inside) > 0 ? Side{a, -side.outwards} : side;
}

template <class Points>
bool ShadowBeam::beyond_a_side(const Points& points) const {
  return std::ranges::any_of(sides_, [&](const Side& side) {
    return std::ranges::all_of(points, [&](const DVec3& p) { return side.beyond(p) > level_ + spread(p); });
  });
}

// in_plane: what lies in the parallelogram's plane counts.
template <class Points>
bool ShadowBeam::beyond_in_height(const Points& points, bool in_plane) const {
  const double least = in_plane ? -level_ : level_;
  return std::ranges::all_of(points, [&](const DVec3& p) { return height(p) <= least; }) ||
         std::ranges::all_of(points, [&](const DVec3& p) { return height(p) >= top_ - level_; });
}

bool ShadowBeam::is_beyond_edge(const DVec3& a, const DVec3& b, const DVec3& inside) const {
  const Side side = side_through(a, b, inside);
  const double margin = level_ + std::max({spread(a), spread(b), spread(inside)});
  return std::ranges::all_of(corners_, [&](const DVec3& corner) { return side.beyond(corner) > margin; });
}

bool ShadowBeam::may_meet(const TreeBox& box) const {
  std::array<DVec3, 8> corners;
  for (std::size_t k = 0; k < 8; ++k)
    corners[k] = {k & 1 ? box.upper.x : box.lower.x, k & 2 ? box.upper.y : box.lower.y,
                  k & 4 ? box.upper.z : box.lower.z};
  return !beyond_in_height(corners, true) && !beyond_a_side(corners);
}

bool ShadowBeam::may_meet(const BeamTriangle& t) const {
  if (beyond_in_height(t, false) || beyond_a_side(t)) return false;
  for (std::size_t k = 0; k < 3; ++k)
    if (is_beyond_edge(t[k], t[(k + 1) % 3], t[(k + 2) % 3])) return false;
  return true;
}

bool ShadowBeam::may_meet(const DVec3& a, const DVec3& b) const {
  const std::array<DVec3, 2> edge{a, b};
  if (beyond_in_height(edge, true) || beyond_a_side(edge)) return false;
  const Side side = side_through(a, b, middle_ + normal_);
  const double margin = level_ + std::max(spread(a), spread(b));
  const auto beyond = [&](double turn) {
    return std::ranges::all_of(corners_, [&](const DVec3& corner) { return turn * side.beyond(corner) > margin; });
  };
  return !beyond(1) && !beyond(-1);
}

bool ShadowBeam::is_blocked_by(const BeamTriangle& t) const {
  for (std::size_t k = 0; k < 3; ++k) {
    const Side side = side_through(t[k], t[(k + 1) % 3], t[(k + 2) % 3]);
    const double margin = level_ + std::max(spread(t[k]), spread(t[(k + 1) % 3]));
    if (side.outwards == DVec3(0)) return false;
    for (const DVec3& corner : corners_)
      if (side.beyond(corner) > -margin) return false;
  }
  const DVec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
  const double of_lamp = sun_ ? glm::dot(normal, lamp_) : glm::dot(normal, lamp_ - t[0]);
  const double least = level_ * glm::length(normal);
  return std::ranges::all_of(corners_, [&](const DVec3& corner) {
    const double of_corner = glm::dot(normal, corner - t[0]);
    return of_lamp > 0 ? of_corner < -least : of_corner > least;
  });
}

bool ShadowBeam::is_cut_by(const BeamTriangle& t) const {
  const std::array<double, 3> heights{height(t[0]), height(t[1]), height(t[2])};
  return std::ranges::min(heights) < -level_ && std::ranges::max(heights) > level_;
}

bool ShadowBeam::in_plane(const DVec3& a, const DVec3& b) const {
  return std::abs(height(a)) <= level_ && std::abs(height(b)) <= level_;
}

bool ShadowBeam::is_front(const BeamTriangle& t) const {
  return glm::dot(glm::cross(t[1] - t[0], t[2] - t[0]), sun_ ? lamp_ : lamp_ - t[0]) > 0;
}

}  // namespace oriel
