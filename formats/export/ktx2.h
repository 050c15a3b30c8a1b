// KTX 2.0 textures, which engines' importers read and GPUs take as they are.
#pragma once

#include "formats/core/bytes.h"
#include "formats/core/result.h"

namespace oriel {

// kRgb9e5: a u32 a texel (formats/core/half.h); kBc6h: blocks (formats/image).
enum class TexelCoding { kRgb9e5, kBc6h };

struct Ktx2Texture {
  TexelCoding coding = TexelCoding::kRgb9e5;
  std::uint32_t width = 0, height = 0;
  std::uint32_t faces = 1;  // 6: a cube, +X -X +Y -Y +Z -Z
  Bytes level;              // all faces, row 0 at v = 0
};

// One level with Zstandard supercompression, linear Rec. 709 (KTX File Format Specification 2.0; Khronos Data Format
// Specification 1.3 for the descriptor). Error kRuntime where zstd fails (out of memory).
Result<Bytes> ktx2_file(const Ktx2Texture& texture);

}  // namespace oriel
