// Render passes that draw cells in the light of several lights each, made fewer: the greedy algorithm of Barczak 2006
// ("Realistic Rendering of Large Sets of Point Lights", 4.3.5, figure 4-10). No OpenGL.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace oriel::study {

// An element: its cells are drawn together, in the light of all its lights, so many lights a pass.
struct LightPass {
  std::vector<std::uint32_t> cells;
  std::vector<std::uint32_t> lights;
};

// Passes that they take; lights_a_pass: 7 in the thesis, 0 reads as 1.
std::size_t count_passes(std::span<const LightPass> elements, std::size_t lights_a_pass);

// Elements in which each pair of a cell and a light is that was in `elements`, once; no more passes. Lists ascend, and
// none is empty. elements: no pair of a cell and a light is in two of them, as where each is one leaf with its lights.
std::vector<LightPass> merge_passes(std::vector<LightPass> elements, std::size_t lights_a_pass);

}  // namespace oriel::study
