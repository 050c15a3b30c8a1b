// Where rigid objects stand, and how animations move them.
#pragma once

#include "formats/core/vec.h"

namespace oriel {

// Where a rigid object stands: a point p of it is at position + rotation · p.
struct MoverPose {
  Vec3 position{0};           // metres
  Vec4 rotation{0, 0, 0, 1};  // unit quaternion x, y, z, w

  bool operator==(const MoverPose&) const = default;
};

struct MoverKey {
  float time_s = 0;
  MoverPose pose;
};

}  // namespace oriel
