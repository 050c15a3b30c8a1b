// K by incidence: the lobe as a texture in mirror-direction coordinates, with its shift and its width.
#pragma once

#include "bake/material/lobe.h"
#include "formats/core/archive.h"

namespace oriel {

struct SliceOptions {
  std::uint32_t count = 9;    // incidences, at least 2, at cosθ = (i / (count-1))², the first at kGrazingCosine
  std::uint32_t size = 31;    // side of a texture, odd, at least 3
  std::uint32_t radial = 32;  // entries of the radial share, at least 2
  float energy = 0.99f;       // share of the lobe that a texture shall hold, (0, 1)
};
inline void fields(Archive& archive, SliceOptions& o) {
  archive(o.count, o.size, o.radial, o.energy);
}

// Lobes at grazing incidence have a limit, but their formulas divide by the cosine.
inline constexpr float kGrazingCosine = 1e-3f;

// The lobe at one incidence, [kGrazingCosine, 1]. alpha: the width of the half vectors' distribution, 1e-5 to 1 (only
// where to look; the lobe decides). The box lies where the tails outside it are equal on both sides; a pixel's
// weight is the integral of the lobe over the solid angle it covers, its sum made 1. albedo, tilt and radial shares
// are within 3e-3 of the exact ones.
KernelSlice make_slice(const LobeFunction& lobe, double alpha, double cos_theta, const SliceOptions& options = {});

// All incidences of a GGX lobe, into kernel.slices and, as transformed cosines, kernel.fits; nothing for a
// mirror (kernel.size 1).
void add_slices(BrdfKernel& kernel, const SliceOptions& options = {});

}  // namespace oriel
