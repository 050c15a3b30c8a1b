// Where a surround map is taken from.
#pragma once

#include "bake/jobs/context.h"
#include "bake/radiance/curved_reflectors.h"
#include "bake/trace/accel.h"

namespace oriel {

// Moves the centre of each map to where it sees most of what eyes (scene space) see in its reflector: pairs of an eye
// and a point of the reflector give rays of the reflected lobe, weighted by solid angle, and a centre sees what such a
// ray meets where nothing but the reflector's own object lies between. Candidates are the middle of the piece's bounds,
// the mean of the points that eyes see, and 27 places within the bounds; the middle stays where none is better. Without
// eyes, too. A tub's rim shows the window, most of which the sill hides from the tub's middle. The view (SurroundView)
// is chosen likewise: what shows itself more than it hides (a tub's inside, from above its bottom) has the fronts of
// its object in its map. The same for the same seed.
Status place_surround_maps(const Accel& accel, std::span<const Vec3> eyes, Context& context,
                           FoundCurvedReflectors& found);

}  // namespace oriel
