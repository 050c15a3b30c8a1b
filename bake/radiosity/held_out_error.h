// The held-out error of a bake: a comparison with unbiased paths at pixels that the bake did not use.
#pragma once

#include <array>

#include "bake/radiosity/radiosity.h"
#include "bake/radiosity/texels/frame_error.h"

namespace oriel {

inline constexpr std::size_t kEstimates = 3;

// The squared error of a pixel relative to its light (relative_square), by three independent unbiased estimates; cd/m².
// (baked - a) (baked - b) is free of the estimates' noise in the mean, however long the tails of the paths are. The
// denominator is the square of the brighter of pixel and third estimate, plus floor2. It must be independent of a and
// b: where paths rarely find a light, a denominator with a or b in it would give the few that do too little weight.
// Each estimate is used once in the denominator.
double squared_error(const DVec3& baked, const std::array<DVec3, kEstimates>& estimates, const DVec3& floor2);

// Parameters of measure_held_out_error().
struct HeldOutQuery {
  double error = 0;  // requested, relative
  std::uint64_t rays_at_most = 0;
  const SharpLight* sharp = nullptr;  // of the pages; null: all light is the texels'
};

// Compares the light of held-out pixels, as the pack stores it (half floats), with three independent path estimates
// each (squared_error). Noisy pixels get more paths, calibrated by a few of their own. Pixels are added in their order
// until the confidence interval of the squared error is a fifth of the requested one, or `rays_at_most` are traced; at
// least 64 are compared. The result does not depend on threads or time. pages: filled, dilated and stitched. Stage name
// "certificate"; error kStopped.
Result<HeldOutError> measure_held_out_error(const LightmapScene& scene, std::span<const LightmapPage> pages,
                                            std::span<const FramePixel> pixels, const HeldOutQuery& query,
                                            Context& context);

}  // namespace oriel
