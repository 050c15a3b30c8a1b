// Texel values whose bilinear interpolation reproduces the texels' mean light.
#pragma once

#include <span>

#include "bake/atlas/texel_map.h"
#include "bake/radiosity/texels/reach.h"
#include "formats/assets/lightmap.h"

namespace oriel {

struct SampledPage {
  const Atlas& atlas;
  const TexelMapPage& map;
  std::span<const Reach> reach{};  // by texel of the map; empty: texels without a whole square stay as they are
};

// Deconvolves a page for display. An estimate's texels hold the mean irradiance of their squares, and bilinear
// interpolation smooths those means a second time. Where light bends (at the border of a penumbra, at the foot of a
// wall), pixels are off by an eighth of the second difference along each axis. So values c are sought whose
// interpolation has the means a again: B c = a, with B = [1 6 1]/8 along each axis. They are found by the iteration c
// += a - B c (Landweber). Each value stays between the means around it, so an edge does not ring. The change d is
// weighted by d² / (d² + (2 σ)²) against noise, σ being the standard error (Wiener).
//
// The mean of a texel at the rim of a chart, or at the foot of a wall, is that of the part which was sampled, beside
// the texel's middle: B has the weights of that part's reach. Its value is then extrapolated, by no more than it
// differs from the means around it, and less the nearer one of them is to having twice its light.
//
// Neighbours are valid texels of the same chart. The sum over a chart stays, within noise and bounds. Standard errors
// stay: they are those of the means. Finite values of at least 0 remain finite and at least 0.
// groups: the pages of the light groups, which sum to `page`. They are fitted with the weights of `page`.
void fit_texels(const SampledPage& sampled, LightmapPage& page, std::span<LightmapPage* const> groups = {});

}  // namespace oriel
