// Pictures as BC6H: 16 bytes for 4 × 4 texels of unsigned half floats, which all desktop devices sample as they are.
#pragma once

#include <span>

#include "formats/core/bytes.h"
#include "formats/core/vec.h"

namespace oriel {

// Rows of blocks from the top, each from the left; what is missing of blocks at the right and bottom repeats the last
// column and row. rgb: width × height values; negative ones and NaN become 0, ones above kHalfMax that. counts: of each
// texel whether its value matters, or empty: all do. Looks for the block of least squared error, each texel's over its
// largest channel. On all cores. The same picture gives the same bytes.
Bytes bc6h_blocks(std::span<const Vec3> rgb, std::uint32_t width, std::uint32_t height,
                  std::span<const std::uint8_t> counts = {});

// What the blocks show: width × height values. blocks: of that size.
std::vector<Vec3> rgb_from_bc6h(std::span<const std::byte> blocks, std::uint32_t width, std::uint32_t height);

}  // namespace oriel
