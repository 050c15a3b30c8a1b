// A reflection model in numbers, angle by angle, so that any table of ours can be checked from outside.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "bake/brdf/metals.h"
#include "formats/core/vec.h"

namespace oriel {

enum class BrdfModel : std::uint8_t { kGgx, kBeckmann, kWard, kWardOriginal, kWardDuer, kPhong };

struct EvaluateOptions {
  BrdfModel model = BrdfModel::kGgx;
  double alpha = 0.1;                                // [1e-4, 1]
  std::optional<std::array<ComplexIndex, 3>> index;  // per channel; none: a surface that reflects all, F = 1
  bool schlick = false;                              // Schlick's F of the same F(0) instead of the exact one
  std::vector<double> angles_deg;                    // [0, 90]
};

// At one angle θ.
struct Evaluation {
  double angle_deg = 0;
  DVec3 f{1};        // Fresnel's factor at incidence θ
  DVec3 f_error{0};  // Schlick's minus the exact one at θ
  double d = 0;      // distribution of half vectors θ off the normal, per steradian
  double g1 = 1;     // Smith's masking of a direction θ off the normal; 1 for Ward and Phong, which have none
  double g2 = 1;     // height-correlated G of that direction and its mirror direction
  DVec3 albedo{0};   // ∫ f cosθi dωi at incidence θ, single scattering
  // The same with what single scattering loses given back; none for Ward's lobe with the
  // norms of 1992 and of Duer: its albedo vanishes or diverges at grazing angles, and a scale to match means nothing.
  std::optional<DVec3> compensated;
};

std::vector<Evaluation> evaluate(const EvaluateOptions& options);

}  // namespace oriel
