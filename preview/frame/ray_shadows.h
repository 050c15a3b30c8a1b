// Shadows by rays from what pixels see: the other way to the same light, and what shadow volumes are checked against.
#pragma once

#include "bake/jobs/context.h"
#include "bake/trace/accel.h"
#include "preview/frame/lamps.h"

namespace oriel {

// By pixel, as SeenSurfaces has them, row 0 at the bottom.
struct SeenPoints {
  int width = 0, height = 0;
  std::vector<Vec4> place;  // a: triangle + 1, 0 where nothing is seen
  std::vector<Vec4> face;   // geometric normals, on the eye's side
};

// What comes of a lamp's point by pixel, RGBA of 8 bits, a = 255; 0 too where it cannot shine. Error kStopped.
Result<std::vector<std::uint8_t>> shadow_mask(const SeenPoints& points, const LampPoint& lamp, const Accel& accel,
                                              Context& context);

}  // namespace oriel
