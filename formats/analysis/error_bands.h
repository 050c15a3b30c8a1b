// Where the error of a lightmap lies: in single texels, which eyes average, or in clouds as large as furniture, which
// they see first.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "formats/pack/pack.h"

namespace oriel {

// Whether the lightmaps' pages and the meshes' lightmap coordinates are the same.
bool same_texels(const Pack& first, const Pack& second);

// Blocks of 1, 2, 4, … 32 texels' side, within connected parts of charts. A band is what blocks differ by from those of
// twice the side: it holds what is as large as its blocks and smaller than the next. Bands are orthogonal, the sum of
// their squares and of `wider` is the squared error. Of white noise each has half of the one before.
constexpr std::size_t kErrorBands = 6;

// Root mean squares over texels, relative to the reference's light around (8 texels wide), what is dark to a tenth of
// its mean over all. What the reference's own standard errors make of them is taken off, 0 at least.
struct BandErrors {
  std::uint64_t texels = 0;
  std::array<double, kErrorBands> band{};
  double wider = 0;  // what blocks of 64 texels are off by
  // Contrast over its threshold (contrast_sensitivity()), each band as a grating whose stripes are as wide as its
  // blocks, seen from the nearest eye before the surface, whatever stands between: 1 is just noticeable.
  double visible = 0;
};

struct PartBands {
  std::uint32_t part = 0;  // into Mesh::parts
  BandErrors errors;
};

struct ErrorBands {
  BandErrors all;
  std::vector<PartBands> parts;  // those with most texels first
};

// Of a pack against a reference of the same atlas; texels count alike, for they are as large as people see them. Eyes
// are the cameras of both packs and the cells of their walk grids; without any, 2 m away. Nothing where the atlases
// differ or no texel is valid in both.
std::optional<ErrorBands> error_bands(const Pack& reference, const Pack& pack);

}  // namespace oriel
