// The pack's tables on the GPU.
#pragma once

#include <span>

#include "formats/pack/pack.h"
#include "player/gpu/texture.h"
#include "player/scene/kernel_taps.h"

namespace oriel {

// One row a map, as wide as the longest table; not filtered.
gpu::Texture2d upload_reflectance_tables(const std::vector<FresnelMap>& maps);
// A row an incidence, a texel a tap: mirror coordinates, width, weight. Not filtered.
gpu::Texture2d upload_kernel_taps(const KernelTaps& taps);
// Row 0: the kernel's fits in the frame of the mirror direction (formats/query); texel i of n is at cosθ = (i /
// (n-1))². Row 1: F where the half vector is at that cosine, and its mean over the lobe at that incidence, given by
// rows as KernelTaps'.
gpu::Texture2d upload_lobe_fits(const BrdfKernel& kernel, const FresnelMap& fresnel,
                                std::span<const float> mean_factors);

}  // namespace oriel
