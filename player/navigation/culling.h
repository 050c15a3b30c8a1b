// Boxes, and what of them a camera can see.
#pragma once

#include <array>
#include <limits>

#include "formats/core/vec.h"

namespace oriel {

// Empty where lower > upper.
struct Bounds {
  Vec3 lower{std::numeric_limits<float>::max()};
  Vec3 upper{std::numeric_limits<float>::lowest()};

  void extend(const Vec3& p) {
    lower = glm::min(lower, p);
    upper = glm::max(upper, p);
  }
  void extend(const Bounds& b) {
    lower = glm::min(lower, b.lower);
    upper = glm::max(upper, b.upper);
  }
  bool empty() const { return !(lower.x <= upper.x); }
  Vec3 center() const { return 0.5f * lower + 0.5f * upper; }
  // Half the diagonal; 0 where empty.
  float radius() const { return empty() ? 0.0f : 0.5f * glm::length(upper - lower); }
};

// The six planes of a clip space: inside where dot(plane, (p, 1)) >= 0.
struct Frustum {
  std::array<Vec4, 6> planes;
};
Frustum make_frustum(const Mat4& clip_from_pack);

// False only where the box lies wholly outside one plane; true for an empty box never.
bool may_be_visible(const Frustum& frustum, const Bounds& bounds);

// The rectangle of normalised device coordinates that a flat convex polygon covers, clipped to the view; nothing where
// it lies outside or behind. corners: pack space, in order around.
struct NdcRect {
  Vec2 lower{0}, upper{0};
  bool empty = true;
};
NdcRect project_polygon(const Mat4& clip_from_pack, const std::array<Vec3, 4>& corners);
// The same around a box, of which what is before the eye counts.
NdcRect project_box(const Mat4& clip_from_pack, const Bounds& box);
// Of the view's area, [0,1].
float share_of_picture(const NdcRect& rect);

}  // namespace oriel
