#include "bake/atlas/stretch.h"

#include <limits>

namespace oriel {
namespace {

constexpr double kSliver = 1e-6;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

void StretchSum::add(const Triangle3& q, const Triangle2& p) {
  const DVec3 e = q[1] - q[0], f = q[2] - q[0], g = q[2] - q[1];
  const double twice_area = glm::length(glm::cross(e, f));
  if (!(twice_area > kSliver * std::max({glm::dot(e, e), glm::dot(f, f), glm::dot(g, g)}))) return;
  const double det = cross2(p[1] - p[0], p[2] - p[0]);
  if (!(std::abs(det) > 0)) {
    collapsed_ = true;
    return;
  }
  const DVec3 s = (e * (p[2].y - p[0].y) - f * (p[1].y - p[0].y)) / det;  // derivatives along x and y
  const DVec3 t = (f * (p[1].x - p[0].x) - e * (p[2].x - p[0].x)) / det;
  const double a = glm::dot(s, s), b = glm::dot(s, t), c = glm::dot(t, t);
  const double root = std::sqrt((a - c) * (a - c) + 4 * b * b);
  const double area = 0.5 * twice_area, ratio = twice_area / std::abs(det);  // Γγ
  surface_ += area;
  plane_ += 0.5 * std::abs(det);
  square_ += area * 0.5 * (a + c);
  angle_ += area * 0.5 * (a + c) / ratio;
  factor_ += area * ratio;
  largest_ = std::max(largest_, 0.5 * (a + c + root));
}

double StretchSum::l2() const {
  if (collapsed_) return kInfinity;
  return surface_ > 0 ? std::sqrt(square_ / surface_ * scale()) : 1;
}

double StretchSum::linf() const {
  if (collapsed_) return kInfinity;
  return surface_ > 0 ? std::sqrt(largest_ * scale()) : 1;
}

double StretchSum::angle() const {
  return surface_ > 0 ? angle_ / surface_ : 1;
}

// Σ of areas in the plane over their scale is the whole surface: the mean of 1/(Γγ) is 1.
double StretchSum::area() const {
  return surface_ > 0 ? 0.5 * (1 + factor_ / surface_ * scale()) : 1;
}

}  // namespace oriel
