// Radiance maps after an edit that changes little: bands of an earlier bake's maps stay, the others are captured.
#pragma once

#include "bake/radiance/capture.h"
#include "bake/radiance/known_reflections.h"

namespace oriel {

struct MapReuse {
  double asked = 0;                   // 0: all were captured
  std::uint32_t bands = 0, kept = 0;  // of 32 rows
  std::uint32_t views = 0;            // reflectors whose viewpoints are those of the bake before
  double error = 0;                   // that this brings: rms over the pixels of all maps, relative
};

// What the bake before knew, what was edited since, and the error that keeping some of it may bring (relative rms).
struct Edit {
  const KnownReflections& known;
  std::vector<Box> boxes;
  double error = 0;
};

// capture_maps(), but for bands of known maps (same reflector, eye, window and size) whose pixels the store still has.
// Such a band stays where no pixel's ray meets an edited box before it ends, and where one of sixteen pixels, captured
// anew, differs by no more than the error, root mean square, relative to the light there and 1 % of the map's mean; a
// pixel that ends elsewhere counts as wholly different. What is behind further mirrors or lobes is told by those pixels
// alone. The same for any number of threads. Error kStopped.
Result<MapReuse> capture_edited_maps(const LitSurroundings& lit, const Edit& edit, const Stage& stage,
                                     std::vector<RadianceMap>& maps);

}  // namespace oriel
