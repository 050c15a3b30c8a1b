// What may stand between a parallelogram and a lamp.
#pragma once

#include <array>
#include <vector>

#include "bake/scene/box_tree.h"

namespace oriel {

using BeamTriangle = std::array<DVec3, 3>;

// The rays from a parallelogram to a point, or to the disk of a sun. Answers err on the side of what may be in the way.
class ShadowBeam {
 public:
  // corners: in order around; normal: unit, where the parallelogram is lit from. level: heights up to which things lie
  // in its plane, m. wider: how many times a sun's disk.
  ShadowBeam(const Light& light, const std::array<DVec3, 4>& corners, const DVec3& normal, double level,
             double wider = 1);

  bool faces_lamp() const { return faces_; }
  bool may_meet(const TreeBox& box) const;
  bool may_meet(const BeamTriangle& triangle) const;
  bool may_meet(const DVec3& a, const DVec3& b) const;  // an edge
  // Whether the triangle is in the way of the ray from the parallelogram's middle to the lamp's.
  bool is_met_midway(const BeamTriangle& triangle) const;
  // Whether the triangle may pass through the parallelogram.
  bool is_cut_by(const BeamTriangle& triangle) const;
  // Whether an edge lies in the parallelogram's plane: beyond such a foot the triangle hides what it leaves lit.
  bool in_plane(const DVec3& a, const DVec3& b) const;

 private:
  // A plane through two points and the lamp, and how far a place is beyond it, m.
  struct Side {
    DVec3 from{0}, outwards{0};
    double beyond(const DVec3& p) const { return glm::dot(outwards, p - from); }
  };
  Side side_through(const DVec3& a, const DVec3& b, const DVec3& inside) const;
  double height(const DVec3& p) const { return glm::dot(normal_, p - corners_[0]); }
  // How far a sun's disk spreads the rays at that distance from the parallelogram, m.
  double spread(const DVec3& p) const { return tangent_ > 0 ? tangent_ * (glm::length(p - middle_) + reach_) : 0; }
  // margins: of each point.
  template <class Points>
  auto margins(const Points& points) const;
  template <class Points, class Margins>
  bool beyond_a_side(const Points& points, const Margins& margins) const;
  template <class Points>
  bool beyond_in_height(const Points& points, bool in_plane) const;
  // Whether the parallelogram lies on the far side of the plane through an edge and the lamp, by more than that.
  bool is_beyond_edge(const Side& side, double margin) const;

  std::array<DVec3, 4> corners_;
  DVec3 normal_, middle_;
  DVec3 lamp_;  // its place, or of a sun the way to it
  bool sun_ = false, faces_ = false;
  double tangent_ = 0, level_ = 0, reach_ = 0, top_ = 0;  // top_: the lamp's height
  std::array<Side, 4> sides_;
};

}  // namespace oriel
