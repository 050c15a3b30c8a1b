// K: the lobe of a microfacet BRDF sampled over directions around the mirror direction, as the kernel texture that
// blurs a reflected image (Bastos et al. 1999, section 8.2.1).
#pragma once

#include "bake/material/lobe.h"
#include "formats/core/archive.h"

namespace oriel {

using LobeOfWidth = std::function<LobeFunction(double alpha)>;

struct KernelOptions {
  std::uint32_t max_size = 31;  // largest side, pixels; the player's cost grows with its square
  float energy = 0.99f;         // share of the lobe that the kernel shall hold, (0, 1)
  float max_half_extent =
      2.0f;  // largest tangent of the half angle: beyond about 63° a plane is a poor chart of directions
};
inline void fields(Archive& archive, KernelOptions& o) {
  archive(o.max_size, o.energy, o.max_half_extent);
}

// The kernel of a lobe whose facets have that width (roughness², clamped to [0, 1]; NaN counts as 1) seen at cos_theta
// (clamped to [1e-4, 1]). A pixel's weight is the integral of the lobe over the solid angle it covers, 0 below the
// horizon; the sum is 1. Pixel axes: x across the plane of incidence, y in it, growing towards the surface normal.
// half_extent is the smallest that holds options.energy, within max_half_extent; energy_kept says how much it does
// hold. The side is odd and chosen so that a pixel is no wider than alpha / 2, within max_size (below 3 it counts as
// 3). alpha below 1e-5 gives the mirror: size 1, half_extent 0.
BrdfKernel make_kernel(float alpha, const LobeOfWidth& lobe_of, float cos_theta = 1, const KernelOptions& options = {});
// Of GGX facets.
BrdfKernel make_kernel(float alpha, float cos_theta = 1, const KernelOptions& options = {});

}  // namespace oriel
