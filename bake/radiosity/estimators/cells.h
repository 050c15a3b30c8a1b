// Which cells of the lightmap get finer light: those in which interpolation between texels misses too much.
#pragma once

#include "bake/atlas/texel_map.h"
#include "bake/radiosity/estimators/radiosity_options.h"

namespace oriel {

// By page and y * width + x, as LightmapPage::cell: log2 of the steps along the cell's side; 0: texels suffice.
using CellLevels = std::vector<std::vector<std::uint8_t>>;

struct CellGoal {
  double error = 0;  // relative, that interpolation may miss
  double floor = 0;  // luminance, lux: what is darker is held against this
  std::uint32_t most_side = kMostDetail;
  std::uint64_t most_points = 0;  // of all cells
};

// Where light bends by D (second difference) from texel to texel, interpolation misses about D / 4 where that is an
// edge, and n steps between texels leave an nth of it. What noise may bend does not count, and what is seen little
// counts less. Where more points would be needed than allowed, more may be missed. light: filled and stitched. shares:
// of frames, by texel, as numbered over all pages in the order of the texel map.
CellLevels choose_cells(const Atlas& atlas, std::span<const TexelMapPage> map, const Radiosity& light,
                        std::span<const float> shares, const CellGoal& goal);

}  // namespace oriel
