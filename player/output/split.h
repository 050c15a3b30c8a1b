// Two pictures as one, parted by a line. No OpenGL.
#pragma once

#include "formats/core/result.h"
#include "formats/image/image.h"

namespace oriel {

// The first column of the right picture: divider [0, 1] of the width.
int split_column(float divider, int width);

// Left of the divider `left`, from it on `right`. One size and channels of both.
ByteImage join_split(const ByteImage& left, const ByteImage& right, float divider);
FloatImage join_split(const FloatImage& left, const FloatImage& right, float divider);

}  // namespace oriel
