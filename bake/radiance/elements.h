// The elements of a reflector: the windows through which its radiance maps look.
#pragma once

#include "bake/radiance/reflectors.h"

namespace oriel {

// Elements over bounds of that size: as few as keep both sides within element_m, or within the smallest larger side
// that needs no more than max_elements. Both counts are at least 1.
struct ElementGrid {
  std::uint32_t x = 1, y = 1;
};
ElementGrid element_grid(const Vec2& size, float element_m, std::uint32_t max_elements);

struct Element {
  Vec2 lower{0}, upper{0};  // reflector x, y
};
// The elements of the grid over the reflector's bounds that its triangles cover, row by row.
std::vector<Element> covered_elements(const Scene& scene, const FoundReflector& found, const ElementGrid& grid);

// Pixels of a map of the element whose longer side has `resolution`: square where neither side is too short.
UVec2 map_size(const Element& element, std::uint32_t resolution);

}  // namespace oriel
