// Running sums down columns of texels.
#pragma once

#include <cstddef>
#include <cstdint>

#include "formats/shadow/simd.h"

namespace oriel {

// Sums 32 columns down the rows: sets the bits of those whose sum is not zero, leaves the changes zero and returns the
// last row's bits.
// stride: from row to row, numbers.
using SumColumn = std::uint32_t (*)(std::int16_t* change, std::size_t stride, std::uint32_t* word, int rows);
SumColumn column_sums(Simd simd);

}  // namespace oriel
