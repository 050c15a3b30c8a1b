// What is seen where the scene ends.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/core/vec.h"

namespace oriel {

// The sky by direction d, pack space: texel (x, y) is at u = ½ + atan2(d.z, d.x) / 2π = (x + ½) / width and at a polar
// angle from +Y of π (y + ½) / height. Its radiance is Pack::sky, which follows lamps, times the texel.
struct SkyMap {
  std::uint32_t width = 0, height = 0;  // 0: it is even
  std::vector<Vec3> texels;             // >= 0

  static constexpr std::uint32_t kMostWidth = 2048, kMostHeight = 1024;
};

}  // namespace oriel
