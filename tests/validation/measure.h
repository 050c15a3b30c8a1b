// The ways by which Oriel gives a number: the meter, and the baked texture.
#pragma once

#include "bake/radiosity/radiosity.h"
#include "tests/validation/case.h"

namespace oriel::validation {

struct Measured {
  double value = 0;
  double error = 0;  // its stated standard error
};

// By reading; a value of NaN where a reading cannot be had that way (a texture holds no direct part,
// and nothing within half a texel of an edge).
using Measurements = std::vector<Measured>;

// `oriel-bake lux` at the readings' points; means and worst values over points of a quadrature.
Measurements measure_by_lux(const Case& c, std::uint64_t seed);

// The lightmap at c.texel_m: bilinear at the readings' points; means area-weighted over texels.
Measurements measure_by_texture(const Case& c, const RadiosityOptions& options, std::uint64_t seed);

}  // namespace oriel::validation
