// Procedural textures as PNG bytes: sRGB, 8 bits, deterministic.
#pragma once

#include "scenes/kit/scene_builder.h"

namespace oriel::sample {

// Each is square with a power of two of texels a side; floors repeat seamlessly.
Texture dark_tiles(int size);        // 4 × 4 slate tiles with light joints
Texture oak_planks(int size);        // 8 planks along v
Texture painting_blocks(int size);   // rectangles of plain colour between black bars
Texture painting_hills(int size);    // ranges of hills under an evening sky
Texture painting_circles(int size);  // overlapping rings
Texture painting_stripes(int size);  // vertical bands

}  // namespace oriel::sample
