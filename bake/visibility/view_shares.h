// How much of what people see each surface is.
#pragma once

#include <span>

#include "bake/trace/accel.h"

namespace oriel {

// Shares of all directions from all eyes, [0,1].
struct ViewShares {
  std::vector<double> front;  // by triangle: that meet its front, or either side of a double-sided one
  std::vector<double> back;   // that meet the back of a one-sided one
};

// Rays from each eye in directions spread evenly over the sphere; eyes are in scene space. The same for the same seed.
ViewShares look_around(const Accel& accel, std::span<const Vec3> eyes, std::uint64_t seed);

// One-sided surfaces whose backs are 0.2 % or more of what the eyes see: nothing is drawn there, and light ends there.
struct SeenBack {
  std::uint32_t surface;
  double share;  // of all directions from all eyes, [0,1]
};
std::vector<SeenBack> seen_backs(const Scene& scene, const ViewShares& views);

}  // namespace oriel
