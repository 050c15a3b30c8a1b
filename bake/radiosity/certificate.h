// Whether a bake holds: unbiased paths at pixels that it did not know would be asked.
#pragma once

#include <array>

#include "bake/radiosity/radiosity.h"
#include "bake/radiosity/texels/frame_error.h"

namespace oriel {

inline constexpr std::size_t kEstimates = 3;

// Squared error of a pixel relative to its light (relative_square), by independent unbiased estimates: (baked - a)
// (baked - b) has no noise of theirs in its mean, however long the tails of the paths are; what it is divided by, the
// square of the brighter of pixel and third estimate plus floor2, must not know a and b either: where paths seldom find
// a light, most of a and b are 0, and divided by what they found the few that found it would weigh too little. Each
// estimate is the divisor once. cd/m².
double squared_error(const DVec3& baked, const std::array<DVec3, kEstimates>& estimates, const DVec3& floor2);

// What of a bake is held against paths.
enum class Ask {
  kPoints,  // the light that pixels show, as the player interpolates it, against that at their very points
  kTexels,  // that of the texels which they read most of, against the mean over these: neither size nor interpolation
};

struct Question {
  Ask what = Ask::kPoints;
  double error = 0;  // asked for: pixels are asked until the squared error is known to a fifth of this one's
  std::uint64_t rays_at_most = 0;
  std::span<const Vec3> eyes{};  // those that the texels were listed for
};

// The light of held-out pixels, of the texels that the pack keeps (as halves), is held against paths with random
// numbers of their own, thrice each (squared_error). Noisy pixels get more paths, as a few of their own foretell. More
// pixels are asked, in their order, until the squared error is known to a fifth of what was asked for, or
// `rays_at_most` are traced; at least 64 are. Nothing depends on threads or the clock. pages: filled, dilated and
// stitched. Stage name "certificate"; error kStopped.
Result<Certificate> certify(const LightmapScene& scene, std::span<const LightmapPage> pages,
                            std::span<const FramePixel> pixels, const Question& question, Context& context);

}  // namespace oriel
