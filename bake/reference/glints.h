// Points, spots and the sun's disk as flat mirrors show them to a camera: no path from an eye meets them.
#pragma once

#include "bake/reference/reference.h"

namespace oriel {

// Adds to `specular` and `total` of a frame what each pixel sees of the scene's mirrored lights (LightSet::mirrored):
// their irradiance at the eye over the pixel's solid angle, so that the light of a lamp too small to see is that of a
// pixel, and a disk has its own radiance. Perspective cameras only: from afar in parallel rays a point has no size at
// all. Mirrors are those of VirtualLights; wider lobes show lamps as paths have them. Returns the rays traced.
std::uint64_t add_glints(const Transport& transport, const Camera& camera, const ReferenceOptions& options,
                         std::uint64_t seed, ReferenceFrame& frame);

}  // namespace oriel
