// K as a few samples of equal energy by incidence, for a shader: the same maths as shaders/lib/kernel.glsl.
#pragma once

#include <vector>

#include "formats/assets/brdf_kernel.h"
#include "formats/assets/fresnel_map.h"

namespace oriel {

struct KernelTap {
  Vec2 at{0};        // mirror coordinates of its direction, as in KernelSlice
  float width = 0;   // side of the square of them that this tap stands for
  float weight = 1;  // its light counts so much; 1 on average over those above the surface
};

struct KernelTaps {
  int count = 1;                // taps a row; 1: a mirror
  int rows = 1;                 // row i is at cosθ = (i / (rows-1))²
  std::vector<KernelTap> taps;  // row by row; tap k of all rows stands for the same part of the lobe
  float median = 0;             // radius that holds half of the energy at normal incidence
};

// `count` samples a row by inverting the cumulative distribution of the weights (rows, then columns) on a Hammersley
// set, so that each stands for 1 / count of the energy. They are the lobe's as it turns from the mirror direction with
// incidence; of a kernel without slices they are centred on the mirror ray and shrink across by the cosine.
// Deterministic. A kernel of size 1 gives one tap at the centre.
KernelTaps make_kernel_taps(const BrdfKernel& kernel, int count);

// Luminance of F where the half vector is at cosθ from the eye; 1 where the map has no factors.
float fresnel_factor(const FresnelMap& map, double cos_theta);
// Weighs each tap by F of its half vector: a lobe seen flat reflects more of what it has from below the mirror
// direction. Gives the mean F of the taps above the surface, row by row.
std::vector<float> weigh_by_fresnel(KernelTaps& taps, const FresnelMap& map);

// The slices around an incidence: share of the one above. The kernel has slices.
struct SlicePosition {
  std::size_t below, above;
  float share;
};
SlicePosition find_slice(const BrdfKernel& kernel, double cos_theta);

// Where a cosine lies among the rows: the row below, and the share of the next.
struct RowPosition {
  int row;
  float next;
};
inline RowPosition kernel_row(float cos_theta, int rows) {
  const float at = std::sqrt(std::fmin(std::fmax(cos_theta, 0.0f), 1.0f)) * static_cast<float>(rows - 1);
  const int row = std::min(static_cast<int>(at), std::max(rows - 2, 0));
  return {row, at - static_cast<float>(row)};
}

}  // namespace oriel
