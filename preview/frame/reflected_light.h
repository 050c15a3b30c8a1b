// Which points reflect light in a pass: of all that surfaces reflect, what the eye sees gets most of.
#pragma once

#include "preview/frame/lamps.h"
#include "preview/frame/neighbours.h"
#include "preview/frame/preview_scene.h"

namespace oriel {

struct ReflectedOptions {
  std::uint32_t elements = 512;  // that there are at most (elements.h); 0: none
  std::size_t points = 36;       // of those, at most
};

// Elements by what they give what the eye sees. Each pass has others and asks for shadows at other places of them; the
// mean over passes is all reflected light. Error kStopped.
Result<std::vector<LampPoint>> reflecting_points(const PreviewScene& scene, const SeenPoints& seen,
                                                 const ReflectedOptions& options, std::uint32_t pass, Context& context);

}  // namespace oriel
