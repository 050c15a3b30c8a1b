// Procedural textures as PNG bytes: sRGB, 8 bits, deterministic.
#pragma once

#include "scenes/kit/scene_builder.h"

namespace oriel::sample {

// Each is square with a power of two of texels a side; floors repeat seamlessly.
PngTexture dark_tiles(int size);        // 4 × 4 slate tiles with light joints
PngTexture oak_planks(int size);        // 8 planks along v
PngTexture painting_blocks(int size);   // rectangles of plain colour between black bars
PngTexture painting_hills(int size);    // ranges of hills under an evening sky
PngTexture painting_circles(int size);  // overlapping rings
PngTexture painting_stripes(int size);  // vertical bands

}  // namespace oriel::sample
