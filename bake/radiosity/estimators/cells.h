// Choice of the cells that get finer light: those in which interpolation between texels has too large an error.
#pragma once

#include "bake/atlas/texel_map.h"
#include "bake/radiosity/estimators/radiosity_options.h"

namespace oriel {

// log2 of the steps along a cell's side, by page and y * width + x as in LightmapPage::cell; 0: texels suffice.
using CellLevels = std::vector<std::vector<std::uint8_t>>;

struct CellGoal {
  double error = 0;  // allowed relative error of interpolation
  double floor = 0;  // luminance, lux: errors of darker places are relative to it
  std::uint32_t most_side = kMostCellSide;
  std::uint64_t most_points = 0;  // of all cells; kDirectPoints without a gather count as one
  std::uint8_t lit_level = 0;     // points up to this level are lit already and count as none
};

// Properties of texels, numbered over all pages in the order of the texel map.
struct CellTexels {
  std::span<const float> importance;                    // by texel: fraction of the frame pixels
  std::span<const char> occlusion_heavy;                // Texels::occlusion_heavy
  std::span<const Vec3> reflected, reflected_variance;  // of TexelLight; empty: all cells gather
  CellTexels of(std::size_t first, std::size_t count) const;
};

// A cell in which interpolation may have too large an error.
struct CellCandidate {
  std::uint32_t page = 0, place = 0;
  double light = 0;          // reference of the error, luminance, lux
  double weight = 0;         // of its error: square root of its importance over the mean
  double error = 0;          // of interpolation, relative to `light`, times `weight`
  bool contact = false;      // a corner texel is partly hidden
  bool stays = false;        // it gets no points
  bool unevaluated = false;  // texels cannot give `error`: it is a guess
  bool gathers = true;       // its points need reflected light, too; else direct light alone
};

// Points with direct light alone that cost as much as one that gathers; with 8 of them cells have a quarter more points
// for the same error of frames.
inline constexpr std::uint64_t kDirectPoints = 4;

// Estimates the interpolation error of all cells. Where light has a second difference D between texels, interpolation
// is off by about D / 4 at an edge, and n steps between texels leave 1/n of that. Noise is subtracted from D. Narrow
// charts, and the rim of a chart with an occluder near, give no second difference: their error is a guess
// (unevaluated). Errors are weighted by importance. light: filled and stitched.
std::vector<CellCandidate> find_cells(const Atlas& atlas, std::span<const TexelMapPage> map, const Radiosity& light,
                                      const CellTexels& texels, const CellGoal& goal);

// Chooses the candidates whose error is above the goal, and their steps. The goal's error is raised until the number of
// points is allowed.
CellLevels choose_cells(std::span<const LightmapPage> pages, std::span<const CellCandidate> found,
                        const CellGoal& goal);

}  // namespace oriel
