// How a flat image of a surface distorts it.
#pragma once

#include "bake/atlas/polygon.h"

namespace oriel {

using Triangle3 = std::array<DVec3, 3>;

// Sums over triangles, relative to the one scale that keeps the whole area: every measure is 1 for an isometry and more
// else. Γ >= γ are the singular values of the affine map from the plane that carries a triangle's image onto it
// (Sander, Snyder, Gortler and Hoppe 2001, "Texture Mapping Progressive Meshes", §3). Means are over the surface.
// Slivers, whose shape says nothing (twice the area under 1e-6 of the longest side's square), are left out.
class StretchSum {
 public:
  void add(const Triangle3& surface, const Triangle2& plane);

  double l2() const;     // root of the mean of (Γ² + γ²) / 2
  double linf() const;   // the largest Γ
  double angle() const;  // mean of (Γ/γ + γ/Γ) / 2
  double area() const;   // mean of (Γγ + 1/(Γγ)) / 2
  double surface_area() const { return surface_; }
  double plane_area() const { return plane_; }

 private:
  double scale() const { return surface_ > 0 ? plane_ / surface_ : 0; }  // areas

  double surface_ = 0, plane_ = 0, square_ = 0, angle_ = 0, factor_ = 0, largest_ = 0;
  bool collapsed_ = false;  // a triangle with area has none in the plane: l2 is infinite
};

}  // namespace oriel
