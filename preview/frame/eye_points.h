// Some of what the eye sees, which tells what reflected light matters.
#pragma once

#include "bake/trace/accel.h"
#include "bake/trace/polygon_light.h"
#include "preview/frame/neighbours.h"

namespace oriel {

struct EyePoint {
  Receiver at;
  Vec3 origin{0};  // of rays that leave it
};

// Of a pixel that sees something.
EyePoint eye_point(const SeenPoints& seen, std::size_t pixel, const Accel& accel);

// Of so many pixels, spread over the frame; fewer where pixels see nothing. seed and pass choose which.
std::vector<EyePoint> eye_points(const SeenPoints& seen, const Accel& accel, std::uint32_t count, std::uint64_t seed,
                                 std::uint32_t pass);

}  // namespace oriel
