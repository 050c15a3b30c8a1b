// Packing of rectangles into pages.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace oriel {

struct PackRect {
  std::uint32_t width = 0, height = 0;   // texels, >= 1
  std::uint32_t x = 0, y = 0, page = 0;  // the result
};
struct PackedPage {
  std::uint32_t width = 0, height = 0;  // the part in use
};
struct PackLimits {
  std::uint32_t width = 0, height = 0;  // of a page; no rectangle is larger
  std::uint32_t padding = 0;            // texels between rectangles (none at a page's border)
  std::uint32_t max_pages = 1;
};

// Skyline, bottom-left: rectangles by decreasing height, each where its top ends lowest (Jylänki 2010, "A Thousand Ways
// to Pack the Bin", §2.3). Depends on the rectangles only. Returns no page where max_pages do not suffice.
std::vector<PackedPage> pack_rects(std::span<PackRect> rects, const PackLimits& limits);

// The same into a page about as wide as high where one suffices.
std::vector<PackedPage> pack_compact(std::span<PackRect> rects, const PackLimits& limits);

}  // namespace oriel
