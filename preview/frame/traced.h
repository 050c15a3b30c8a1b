// Specular pixels by rays (U9): what polished surfaces reflect and what is behind glass and cut-outs.
#pragma once

#include "bake/jobs/context.h"
#include "formats/query/camera.h"
#include "preview/frame/lamp_rays.h"
#include "preview/frame/preview_scene.h"

namespace oriel {

// What a pass drew, as textures have it: row 0 at the bottom.
struct TracedFrame {
  const SeenPoints& seen;
  Mat4 clip_from_pack{1};
  Vec4 eye{0, 0, 0, 1};
  const std::vector<Vec4>& light;         // irradiance, lux: what rays find again where they meet what the frame shows
  std::span<const LampPoint> reflecting;  // of the pass: light of surfaces on what the frame does not show
};

struct TracedLight {
  std::vector<Vec4> light;  // cd/m², by pixel
  std::size_t pixels = 0;   // that were traced
};

// One ray into the lobe of each tagged pixel, and one through it where it lets light pass; rows are farmed to threads.
// Diffuse surfaces that rays meet show what the frame has of them, where it sees them; else a few points on
// lamps and a few that reflect light, with their shadows. pass: picks the rays. Error kStopped.
Result<TracedLight> trace_specular(const PreviewScene& scene, const TracedFrame& frame, std::uint32_t pass,
                                   Context& context);

}  // namespace oriel
