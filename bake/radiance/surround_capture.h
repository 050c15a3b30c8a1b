// Surround maps: what is seen all around from inside each curved reflector.
#pragma once

#include "bake/radiance/capture.h"
#include "bake/radiance/curved_reflectors.h"

namespace oriel {

// Fills the texels of the maps of `found`: one ray through each texel's centre, so that colour and distance belong to
// the same point. What lies inside the reflector's object, up to the last of its own triangles that the ray leaves by
// their back, or of those without a back, is not seen, nor is any of its triangles. Surfaces that let at least half of
// the light pass are walked through as in capture_maps; emission is included, of glossy reflectors too. The back of a
// one-sided surface keeps its distance, with radiance 0 and valid 0. Radiance that is not finite or negative counts as
// 0. The same bytes for any number of threads. Error kStopped.
Status capture_surroundings(const Accel& accel, FoundCurvedReflectors& found, const OutgoingRadiance& outgoing,
                            const Stage& stage);

// Adds points, spots and suns to captured maps as lamps of the texels that they lie in, so that lobes show their
// highlights: the light's illuminance at the map's centre over the texels' solid angle, where it comes through. Texels
// keep their distance. Of several hours of a day none has its sun in them, as one map shows all hours.
void add_punctual_lights(const Accel& accel, FoundCurvedReflectors& found);

}  // namespace oriel
