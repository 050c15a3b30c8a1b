// Lightmap pages as KTX 2.0 textures, which engines' importers read and GPUs take as they are.
#pragma once

#include "formats/assets/lightmap.h"
#include "formats/core/bytes.h"
#include "formats/core/result.h"

namespace oriel {

// What one unit of a page's texture means, lux: 1, or the power of two that brings the page within kRgb9e5Max.
float ktx2_scale(const LightmapPage& page);

// The irradiance of a page over ktx2_scale() as one level of VK_FORMAT_E5B9G9R9_UFLOAT_PACK32, linear Rec. 709, row 0
// at v = 0, with Zstandard supercompression (KTX File Format Specification 2.0; Khronos Data Format Specification 1.3
// for the descriptor). A channel is off by at most 2^-9 of its texel's largest. Error kRuntime where zstd fails (out
// of memory).
Result<Bytes> lightmap_ktx2(const LightmapPage& page);

// What that rounding changes: root mean square over channels of texels with light, relative to the texel's largest.
double ktx2_rounding(const LightmapPage& page);

}  // namespace oriel
