// One block of BC6H: fields to 16 bytes and back.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "formats/core/vec.h"
#include "formats/image/modes.h"

namespace oriel::bc6h {

using Block = std::array<std::byte, 16>;
using Halves = std::array<glm::vec<3, std::uint16_t>, kTexels>;

// What a block says.
struct Fields {
  std::size_t mode = 0;                                     // into modes()
  std::array<std::array<std::uint32_t, 3>, 4> endpoints{};  // quantised; differences are resolved
  std::uint32_t partition = 0;
  std::array<std::uint8_t, kTexels> index{};
};

// fields: differences fit the mode's bits, anchors have no highest bit.
Block packed(const Fields& fields);
// False for one of the four reserved codes.
bool unpacked(const Block& block, Fields& fields);

// The texels of a block; of reserved codes black, as devices show them.
Halves decoded(const Block& block);

}  // namespace oriel::bc6h
