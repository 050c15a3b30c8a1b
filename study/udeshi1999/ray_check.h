// Shadow volumes against rays, pixel by pixel, and what volumes tell of regions.
#pragma once

#include <array>

#include "study/udeshi1999/hybrid_renderer.h"

namespace oriel::study {

// Pixels that a lamp's point could shine on, over all of its points but for the frame's rim. On silhouettes rays and
// the raster may differ: neighbours do.
struct RayCheck {
  std::size_t lit = 0, dark = 0, silhouettes = 0;
  std::size_t wrong = 0, wrong_on_silhouettes = 0;  // not as rays have it
  // Blocks of 8 × 8 pixels by lamp that all its points shine on wholly, none, or some: lit, umbra and penumbra.
  std::array<std::size_t, 3> blocks{};
  std::vector<float> reached;  // by pixel: the share of points that shine on it, were they alike (the grey shadow)
  double rays_s = 0;           // that direct light takes by rays to the same points
};

// Of what the renderer sees. cap_rays: as HybridOptions. forget_eye: the check's own check, as if no volume held the
// eye. Error kStopped.
Result<RayCheck> check_by_rays(HybridRenderer& renderer, const PreviewScene& scene, std::span<const LampPoint> lamps,
                               std::uint32_t cap_rays, Context& context, bool forget_eye = false);

}  // namespace oriel::study
