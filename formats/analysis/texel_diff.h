// Two bakes of one atlas beside each other, texel by texel: how far the second is off the first, its reference.
#pragma once

#include <cstdint>
#include <optional>

#include "formats/pack/pack.h"

namespace oriel {

// Whether the lightmaps' pages and the meshes' lightmap coordinates are the same.
bool same_texels(const Pack& first, const Pack& second);

// Over texels that are valid in both packs, of luminance: root mean squares of relative differences, as shares. "Net"
// is without what the first pack's standard errors alone make of it (its square is taken off), 0 at least.
struct TexelDiff {
  std::uint64_t texels = 0;
  double mean_lux = 0;    // of the first pack
  double difference = 0;  // relative to the first's light plus 1 % of its mean, in quadrature (relRMSE)
  double noise = 0;       // what the first's standard errors make of that
  double stated = 0;      // and the second's
  double net = 0;
  double net_without_worst = 0;  // the same without the hundredth of the texels that is farthest off
  double net_of_brighter = 0;    // relative to the brighter of both: a texel counts for its whole light at most
  double bias = 0;               // of the mean, relative
};

// Nothing where the lightmaps' pages or the meshes' lightmap coordinates differ, no texel is valid in both, or only the
// first is all black.
std::optional<TexelDiff> diff_texels(const Pack& first, const Pack& second);

}  // namespace oriel
