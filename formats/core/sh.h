// Real spherical harmonics: orthonormal over the sphere, no Condon–Shortley phase, polar axis z. Coefficient (l, m)
// lies at index l(l+1)+m, so that indices 1, 2, 3 go with y, z, x. `bands` n means l < n: n² coefficients.
#pragma once

#include <span>
#include <vector>

#include "formats/core/vec.h"

namespace oriel {

inline constexpr int kMaxShBands = 16;

constexpr int sh_count(int bands) {
  return bands * bands;
}
constexpr int sh_index(int l, int m) {
  return l * (l + 1) + m;
}

// All Y_lm of a unit direction. out.size() is a square of 1 to kMaxShBands.
void evaluate_sh(const DVec3& direction, std::span<double> out);
void evaluate_sh(const Vec3& direction, std::span<float> out);

// ∫ max(cosθ, 0) P_l(cosθ) dω: the factor by which radiance coefficients of band l become those of irradiance
// (Ramamoorthi & Hanrahan 2001, "An Efficient Representation for Irradiance Environment Maps", equation (8)).
double cosine_factor(int l);

// Coefficients of a function that is symmetric about `axis` (unit), from those (l, 0) of the same about +z; one a band.
void turn_zonal(std::span<const double> zonal, const DVec3& axis, std::span<double> out);

// Takes coefficients of f to those of f(R⁻¹ω). Matrices band by band (Ivanic & Ruedenberg 1996, "Rotation Matrices for
// Real Spherical Harmonics", with the corrections of 1998).
class ShRotation {
 public:
  // rotation: orthonormal, determinant 1.
  ShRotation(const DMat3& rotation, int bands);
  // in and out: bands² coefficients, not the same memory.
  void apply(std::span<const double> in, std::span<double> out) const;
  void apply(std::span<const float> in, std::span<float> out) const;
  // Row m, column n of band l.
  double at(int l, int m, int n) const;

 private:
  int bands_;
  std::vector<double> matrices_;  // (2l+1)² a band, row by row
};

// Scales band l by 1 / (1 + λ l²(l+1)²), the smooth window that costs the least squared error for the curvature it
// takes away (Sloan 2008, "Stupid Spherical Harmonics Tricks", windowing). Band 0, the mean, stays.
void window_sh(double lambda, std::span<double> coefficients);

// The least λ, to 1 %, for which f after the window is nowhere below -tolerance times its mean; 0 where none is needed.
// A function without a positive mean has none: it is to be cleared. Finds the minimum on a fixed set of directions.
double window_without_ringing(std::span<const double> coefficients, double tolerance = 1e-3);

}  // namespace oriel
