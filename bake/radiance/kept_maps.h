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

// capture_maps(), but for bands of maps of `known` (same reflector, eye, window and size) whose pixels the store still
// has. Such a band stays where no pixel's ray meets an edited box before it ends, and where one of sixteen pixels,
// captured anew, differs by no more than `error`, root mean square, relative to the light there and 1 % of the map's
// mean; a pixel that ends elsewhere counts as wholly different. What is behind further mirrors or lobes is told by
// those pixels alone. The same for any number of threads. Error kStopped.
Status capture_edited_maps(const ReflectedSurroundings& surroundings, const OutgoingRadiance& outgoing,
                           const KnownReflections& known, std::span<const Box> edited, double error, Context& context,
                           std::vector<RadianceMap>& maps, MapReuse& reuse, std::atomic<std::uint64_t>* rays);

}  // namespace oriel
