// Surfaces that lie in one plane and overlap: carpets on floors, posters on walls, panels in ceilings, copies.
#pragma once

#include "bake/jobs/context.h"
#include "bake/scene/scene.h"

namespace oriel {

// Of surfaces that lie in one place with their fronts to one side, what rays meet and what a frame shows is a matter of
// rounding. A *patch* is the part of a surface that lies in one plane and hangs together. Of patches that overlap, the
// smaller lies on top, of copies that which lets light through, then the later: carpets on floors, lamps on ceilings.
// What lies on top is moved to its front, and its neighbours in its object with it, so that nothing opens: by a ten
// thousandth of the scene's radius, at most a millimetre, but never less than rays tell apart (1e-5 of the radius), for
// each layer below it, at most eight. What lies so little before it that it would be overtaken is moved on too.
// The face of a body that stands on a sheet's other side, as furniture on a floor whose other side is a ceiling, is
// moved into the body instead: nobody is to see it from below. So is glass that stands on something: rays that pass it
// would start below that. A warning names what was moved. Movers are layered among themselves.
void separate_layers(Scene& scene, Context& context);

}  // namespace oriel
