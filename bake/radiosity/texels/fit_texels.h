// Texel values whose bilinear interpolation reproduces the texels' mean light.
#pragma once

#include <span>

#include "bake/atlas/texel_map.h"
#include "formats/assets/lightmap.h"

namespace oriel {

// Deconvolves a page for display. An estimate's texels hold the mean irradiance of their squares, and bilinear
// interpolation smooths those means a second time. Where light bends (at the border of a penumbra, at the foot of a
// wall), pixels are off by an eighth of the second difference along each axis. So values c are sought whose
// interpolation has the means a again: B c = a, with B = [1 6 1]/8 along each axis. They are found by the iteration c
// += a - B c (Landweber). Each value stays between the means around it, so an edge does not ring. The change d is
// weighted by d² / (d² + (2 σ)²) against noise, σ being the standard error (Wiener).
//
// Neighbours are valid texels of the same chart; texels without a whole square of surface stay as they are. The sum
// over a chart stays, within noise and bounds. Standard errors stay: they are those of the means. Finite values of at
// least 0 remain finite and at least 0.
// groups: the pages of the light groups, which sum to `page`. They are fitted with the weights of `page`.
void fit_texels(const Atlas& atlas, const TexelMapPage& map, LightmapPage& page,
                std::span<LightmapPage* const> groups = {});

}  // namespace oriel
