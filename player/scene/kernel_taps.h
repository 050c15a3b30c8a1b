// K as a few samples of equal energy, for a shader.
#pragma once

#include <vector>

#include "formats/assets/brdf_kernel.h"

namespace oriel {

inline constexpr int kMaxKernelTaps = 64;

struct KernelTap {
  Vec2 tangent{0};  // offset from the mirror direction, as in BrdfKernel
  float width = 0;  // side of the square of the tangent plane that this tap stands for
};

struct KernelTaps {
  std::vector<KernelTap> taps;  // one at 0 for a mirror
  float median = 0;             // tangent within which half of the energy lies
};

// `count` samples of the kernel's weights, by inverting their cumulative distribution (rows, then columns) on a
// Hammersley set, so that each stands for 1 / count of the energy. Deterministic. A kernel of size 1 gives one tap at
// the centre.
KernelTaps make_kernel_taps(const BrdfKernel& kernel, int count);

}  // namespace oriel
