// K: how a glossy material spreads the reflected image (Bastos et al. 1999, section 8.2.1).
#pragma once

#include <vector>

#include "formats/core/vec.h"

namespace oriel {

enum class KernelModel : std::uint8_t { kBeckmannDg = 0, kGgxDg = 1 };

// A square kernel over the tangent plane of the mirror direction: pixel (x, y) is the direction
// (tx, ty, 1) with t = ((i + ½) / size * 2 - 1) * half_extent, that is t = tan of the angle from the mirror direction.
// Sum of weights 1. size 1 is the mirror.
struct BrdfKernel {
  KernelModel model = KernelModel::kGgxDg;
  float alpha = 0;             // microfacet width, roughness²
  float cos_theta = 1;         // incidence it was sampled at
  float half_extent = 0;       // tangent of the half angle it covers
  float energy_kept = 1;       // share of the whole lobe inside it before normalising
  std::uint32_t size = 1;      // odd
  std::vector<float> weights;  // size * size
};

}  // namespace oriel
