// Passes and paths in one frame, each where it errs less.
#pragma once

#include "preview/frame/paths.h"

namespace oriel {

// RGBA, a: 1. passes: RGB, of the same size. How far paths are from the passes is taken apart by scale, from pixels to
// 64 of them (à-trous wavelets, Starck & Murtagh 2006), relative to the passes. At each scale and place the part of it
// that is no noise of the paths is believed (Wiener's filter): d² less n² of d², of what it is around there, d, and of
// what half of the paths differ from the others, n. So few paths mend what is wrong over large parts of the frame
// alone, and many are the frame in the end. Of fewer than four paths too little is known: passes. Error kStopped.
Result<FloatImage> blend_paths(const PathMean& paths, const FloatImage& passes, Context& context);

}  // namespace oriel
