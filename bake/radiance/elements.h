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
  std::uint32_t index = 0;  // in the grid, row by row
};
// The elements of the grid over the reflector's bounds that its triangles cover, row by row.
std::vector<Element> covered_elements(const Scene& scene, const FoundReflector& found, const ElementGrid& grid);

// Pixels of a map of the element whose longer side has `resolution`: square where neither side is too short.
UVec2 map_size(const Element& element, std::uint32_t resolution);

inline constexpr std::uint64_t kMapBytesPerPixel = 4;  // of a map in a pack, at most (docs/notes/format.md)
inline std::uint64_t map_bytes(std::uint32_t width, std::uint32_t height) {
  return kMapBytesPerPixel * width * height;
}
inline std::uint64_t map_bytes(const Element& element, std::uint32_t resolution) {
  const UVec2 size = map_size(element, resolution);
  return map_bytes(size.x, size.y);
}

// A map of that size (map_size) without pixels.
RadianceMap blank_map(std::uint32_t reflector, const Vec3& eye, const Element& element, std::uint32_t resolution);

}  // namespace oriel
