// Packing of charts, as the texels that they cover, into pages.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace oriel {

// The texels of a chart's box that it covers.
class TexelMask {
 public:
  TexelMask() = default;
  TexelMask(std::uint32_t width, std::uint32_t height)
      : width_(width), height_(height), words_((width + 63) / 64), bits_(std::size_t{words_} * height, 0) {}

  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  bool at(std::uint32_t x, std::uint32_t y) const { return bits_[std::size_t{y} * words_ + x / 64] >> (x % 64) & 1; }
  void set(std::uint32_t x, std::uint32_t y) {
    bits_[std::size_t{y} * words_ + x / 64] |= std::uint64_t{1} << (x % 64);
  }
  void set_span(std::uint32_t first, std::uint32_t last, std::uint32_t y);  // inclusive
  std::size_t count() const;
  // Turned by 90°: texel (x, y) goes to (height - 1 - y, x).
  TexelMask turned() const;

 private:
  std::uint32_t width_ = 0, height_ = 0, words_ = 0;
  std::vector<std::uint64_t> bits_;
};

struct PackedChart {
  std::uint32_t page = 0, x = 0, y = 0;  // of the turned mask's lowest texel
  std::uint32_t turns = 0;               // by 90°, 0 to 3
};
struct PackedPage {
  std::uint32_t width = 0, height = 0;  // the part in use
};
struct PackLimits {
  std::uint32_t width = 0, height = 0;  // of a page; no mask is wider or higher
  std::uint32_t padding = 0;            // empty texels between two charts, diagonally too (none at a page's border)
  std::uint32_t max_pages = 1;
};

// What the charts need with their padding, about; never more than twice too little.
double padded_area(std::span<const TexelMask> masks, std::uint32_t padding);

// Charts by decreasing size, each turned so and put there that its top ends lowest: the bottom-left rule on bitmaps, so
// that small charts fill the hollows and holes of large ones. Rows that refused a chart are not asked again by those of
// about its size and fill, which makes the work nearly proportional to the texels. Depends on the masks only. Returns
// no page where max_pages do not suffice. charts.size() == masks.size().
std::vector<PackedPage> pack_masks(std::span<const TexelMask> masks, const PackLimits& limits,
                                   std::span<PackedChart> charts);

// The same, but charts that need less than a page get one about as wide as high, of the width that is filled best.
std::vector<PackedPage> pack_compact(std::span<const TexelMask> masks, const PackLimits& limits,
                                     std::span<PackedChart> charts);

}  // namespace oriel
