// Which cells of the lightmap get finer light: those in which interpolation between texels misses too much.
#pragma once

#include "bake/atlas/texel_map.h"
#include "bake/radiosity/estimators/radiosity_options.h"

namespace oriel {

// By page and y * width + x, as LightmapPage::cell: log2 of the steps along the cell's side; 0: texels suffice.
using CellLevels = std::vector<std::vector<std::uint8_t>>;

// Cells of up to 2^kWholeLevel steps have all their points lit. Those of more have all of that level, and finer ones
// where these differ: an edge crosses few of them.
inline constexpr std::uint8_t kWholeLevel = 3;

// Whether a cell has points of a level.
inline bool has_points(std::uint8_t of_cell, std::uint8_t level) {
  return level == kWholeLevel ? of_cell >= level : of_cell == level;
}

struct CellGoal {
  double error = 0;  // relative, that interpolation may miss
  double floor = 0;  // luminance, lux: what is darker is held against this
  std::uint32_t most_side = kMostDetail;
  std::uint64_t most_points = 0;  // of all cells; of those that gather nothing kDirectPoints count as one
  std::uint8_t known = 0;         // level up to which points are known already and count for none
};

// What is known of texels, numbered over all pages in the order of the texel map.
struct CellTexels {
  std::span<const float> importance;  // of frames
  std::span<const char> crowded;           // whether something stands or hangs close to it (Texels::occlusion_heavy)
  std::span<const Vec3> reflected, reflected_variance;  // TexelLight; empty: all cells gather
  CellTexels of(std::size_t first, std::size_t count) const;
};

// A cell in which interpolation may miss too much.
struct CellCandidate {
  std::uint32_t page = 0, place = 0;
  double light = 0;      // that it is held against, luminance, lux
  double weight = 0;     // of its error: the root of how much more than other cells people see it
  double error = 0;      // what interpolation misses, relative to `light`, weighted
  bool contact = false;  // something stands or hangs on a corner
  bool stays = false;    // it has no points whatever it misses
  bool untold = false;   // texels do not tell what interpolation misses: `error` is a guess
  bool gathers = true;   // reflected light, too, is more than texels tell; else its points have direct light alone
};

// Points with direct light alone that take the time of one that gathers, of which rays go on from what is near: a few
// hundred rays against a few dozen.
inline constexpr std::uint64_t kDirectPoints = 8;

// Where light bends by D (second difference) from texel to texel, interpolation misses about D / 4 where that is an
// edge, and n steps between texels leave an nth of it. What noise may bend does not count. In narrow charts, and at the
// rim of one where something is close by, texels do not tell. What is seen little counts less. light: filled and
// stitched.
std::vector<CellCandidate> find_cells(const Atlas& atlas, std::span<const TexelMapPage> map, const Radiosity& light,
                                      const CellTexels& texels, const CellGoal& goal);

// Those of the candidates that miss more than the goal allows, and so many steps. Where more points would be needed
// than allowed, more may be missed.
CellLevels choose_cells(std::span<const LightmapPage> pages, std::span<const CellCandidate> found,
                        const CellGoal& goal);

}  // namespace oriel
