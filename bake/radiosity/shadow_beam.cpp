#include "bake/radiosity/shadow_beam.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace oriel {
namespace {

constexpr double kGrazing = 1e-4;  // sine of the least height of a sun over a surface that it lights

}  // namespace

ShadowBeam::ShadowBeam(const Light& light, const std::array<DVec3, 4>& corners, const DVec3& normal, double level,
                       double wider)
    : corners_(corners),
      normal_(normal),
      middle_(0.25 * (corners[0] + corners[1] + corners[2] + corners[3])),
      lamp_(light.type == LightType::kDirectional ? -DVec3(light.direction) : DVec3(light.position)),
      sun_(light.type == LightType::kDirectional),
      tangent_(sun_ ? wider * std::tan(double{light.angular_radius_rad}) : 0),
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
auto ShadowBeam::margins(const Points& points) const {
  std::array<double, std::tuple_size_v<Points>> margins;
  for (std::size_t k = 0; k < points.size(); ++k) margins[k] = level_ + spread(points[k]);
  return margins;
}

template <class Points, class Margins>
bool ShadowBeam::beyond_a_side(const Points& points, const Margins& margins) const {
  return std::ranges::any_of(sides_, [&](const Side& side) {
    for (std::size_t k = 0; k < points.size(); ++k)
      if (side.beyond(points[k]) <= margins[k]) return false;
    return true;
  });
}

// in_plane: what lies in the parallelogram's plane counts.
template <class Points>
bool ShadowBeam::beyond_in_height(const Points& points, bool in_plane) const {
  const double least = in_plane ? -level_ : level_;
  return std::ranges::all_of(points, [&](const DVec3& p) { return height(p) <= least; }) ||
         std::ranges::all_of(points, [&](const DVec3& p) { return height(p) >= top_ - level_; });
}

bool ShadowBeam::is_beyond_edge(const Side& side, double margin) const {
  return std::ranges::all_of(corners_, [&](const DVec3& corner) { return side.beyond(corner) > margin; });
}

bool ShadowBeam::may_meet(const TreeBox& box) const {
  std::array<DVec3, 8> corners;
  for (std::size_t k = 0; k < 8; ++k)
    corners[k] = {k & 1 ? box.upper.x : box.lower.x, k & 2 ? box.upper.y : box.lower.y,
                  k & 4 ? box.upper.z : box.lower.z};
  return !beyond_in_height(corners, true) && !beyond_a_side(corners, margins(corners));
}

bool ShadowBeam::may_meet(const BeamTriangle& t) const {
  if (beyond_in_height(t, false)) return false;
  const auto of_corners = margins(t);
  if (beyond_a_side(t, of_corners)) return false;
  const double most = std::ranges::max(of_corners);
  for (std::size_t k = 0; k < 3; ++k)
    if (is_beyond_edge(side_through(t[k], t[(k + 1) % 3], t[(k + 2) % 3]), most)) return false;
  return true;
}

bool ShadowBeam::may_meet(const DVec3& a, const DVec3& b) const {
  const std::array<DVec3, 2> edge{a, b};
  if (beyond_in_height(edge, true)) return false;
  const auto of_ends = margins(edge);
  if (beyond_a_side(edge, of_ends)) return false;
  const Side side = side_through(a, b, middle_ + normal_);
  const double most = std::ranges::max(of_ends);
  return !is_beyond_edge(side, most) && !is_beyond_edge({side.from, -side.outwards}, most);
}

bool ShadowBeam::is_met_midway(const BeamTriangle& t) const {
  // Möller and Trumbore 1997
  const DVec3 way = sun_ ? lamp_ : lamp_ - middle_, ab = t[1] - t[0], ac = t[2] - t[0], from = middle_ - t[0],
              across = glm::cross(way, ac), over = glm::cross(from, ab);
  const double size = glm::dot(ab, across), b = glm::dot(from, across) / size, c = glm::dot(way, over) / size;
  const double far = glm::dot(ac, over) / size, at = height(middle_ + far * way);
  return b >= 0 && c >= 0 && b + c <= 1 && far > 0 && at > level_ && at < top_ - level_;
}

bool ShadowBeam::is_cut_by(const BeamTriangle& t) const {
  const std::array<double, 3> heights{height(t[0]), height(t[1]), height(t[2])};
  if (std::ranges::min(heights) >= -level_ || std::ranges::max(heights) <= level_) return false;
  std::array<DVec3, 2> line;
  for (std::size_t k = 0, end = 0; k < 3; ++k)
    if (const double from = heights[k], to = heights[(k + 1) % 3]; (from < 0) != (to < 0))
      line[end++] = t[k] + from / (from - to) * (t[(k + 1) % 3] - t[k]);
  return may_meet(line[0], line[1]);
}

bool ShadowBeam::in_plane(const DVec3& a, const DVec3& b) const {
  return std::abs(height(a)) <= level_ && std::abs(height(b)) <= level_;
}

}  // namespace oriel
