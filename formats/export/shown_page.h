// A lightmap page as what its surfaces show: for viewers that know no lightmaps.
#pragma once

#include "formats/image/image.h"
#include "formats/pack/pack.h"

namespace oriel {

// Radiance (cd/m²) of all surfaces of a page by its coordinates, three channels, `scale` times the page's size:
// (diffuse albedo (1 - max R) + R) × irradiance / π + emission, from texture, vertex colour and material; R is the mean
// over directions. That is what the player shows without images: reflections are the light around, and what a surface
// lets through counts as if it were opaque. Texels near surfaces are filled from them. pack: one that
// validate() finds no error in.
FloatImage shown_page(const Pack& pack, std::size_t page, std::uint32_t scale);

// How many times finer than the page it must be for the textures on it, so that no side exceeds `longest`: 1 to 4.
std::uint32_t fitting_scale(const Pack& pack, std::size_t page, std::uint32_t longest);

}  // namespace oriel
