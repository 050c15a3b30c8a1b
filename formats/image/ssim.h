// Structural similarity (Wang, Bovik, Sheikh and Simoncelli 2004).
#pragma once

#include "formats/image/image.h"

namespace oriel {

// By pixel, one channel, [-1, 1] with 1 for equal neighbourhoods: of the luma (Rec. 709 weights of encoded values) of
// two pictures of one size, three channels in [0, 1]. Window: Gaussian of sigma 1.5 over 11 x 11 pixels; K1 = 0.01,
// K2 = 0.03. Its mean is the published index but for the border, where the paper leaves out what the window does not
// fit into and the picture is extended here.
FloatImage ssim_map(const FloatImage& a, const FloatImage& b);

}  // namespace oriel
