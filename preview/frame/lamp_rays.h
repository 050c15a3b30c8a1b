// The light of lamps on what pixels see, by rays.
#pragma once

#include <atomic>
#include <span>

#include "bake/trace/accel.h"
#include "preview/frame/eye_points.h"
#include "preview/frame/shadow_classes.h"

namespace oriel {

// How pixels share points on lamps (Keller & Heidrich 2001, "Interleaved Sampling"). In each block of side × side
// pixels everyone takes other points; then a pixel takes the mean of those around it that lie on its surface
// (neighbours.h). All points light what is even, for 1 / side² of the rays.
struct SharedPoints {
  int side = 1;            // 1 to 3; 1: every pixel takes all points
  std::uint32_t turn = 0;  // who takes which
  // Of one side: what earlier passes tell, begun for these points; null: all rays are traced.
  ShadowClasses* classes = nullptr;
  std::atomic<std::size_t>* rays = nullptr;  // is grown by those that are traced
};
// The side for so many points: each pixel takes at least two.
int sharing_side(std::size_t points);

// By pixel: irradiance, lux, and (a), of side 1, how many of its points can shine on it, were nothing between. Error
// kStopped.
Result<std::vector<Vec4>> lamps_by_rays(const SeenPoints& seen, std::span<const LampPoint> lamps, const Accel& accel,
                                        const SharedPoints& shared, Context& context);

}  // namespace oriel
