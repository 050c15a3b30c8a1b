// Radiance maps with depth: what each viewpoint behind a reflector sees through its element.
#pragma once

#include <functional>

#include "bake/jobs/context.h"
#include "bake/radiance/views.h"

namespace oriel {

// Radiance (cd/m²) that leaves a hit surface towards the eye (unit vector from the hit). Called from any thread.
using OutgoingRadiance = std::function<Vec3(const Hit&, const Vec3& towards_eye)>;

struct CaptureOptions {
  bool has_emission = true;  // outgoing includes emission: recorded in the maps
};

// Fills the pixels of maps planned by plan_views (formats/assets/radiance_map.h says how): one ray through each pixel's
// centre, so that colour and depth belong to the same point. Surfaces that let at least half of the light pass in
// some channel are walked through; what they hide and show is weighted by their transmittance, and depth is that of
// what lies behind. The reflector's own triangles are never hit. The back of a one-sided surface keeps its depth, with
// radiance 0 and valid 0. Radiance that is not finite or negative counts as 0. Adds to `rays` (may be null). The same
// bytes for any number of threads. Error kStopped.
Status capture_maps(const Accel& accel, std::span<const FoundReflector> reflectors, const OutgoingRadiance& outgoing,
                    const CaptureOptions& options, Context& context, std::vector<RadianceMap>& maps,
                    std::atomic<std::uint64_t>* rays = nullptr);

}  // namespace oriel
