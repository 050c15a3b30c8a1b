// Lines under thin walls, at which the charts of floors, ceilings and other walls end.
#pragma once

#include "bake/jobs/context.h"
#include "bake/trace/accel.h"

namespace oriel {

// A floor that goes on under a wall has texels on both sides of it, and filtering would mix the light of two rooms
// there: the edge at which light jumps has to be one of the mesh (Heckbert 1992, Lischinski et al. 1992: D0). Walls are
// found on flat surfaces that stand still, from what cuts a plane just above them: straight, half a metre long or more
// and without an opening as wide, with the surface open on both sides and a wall up to 0.4 m thick between. A line runs
// along its middle, and over the whole of the flat surface up to other lines, so that it parts the surface. scale: of
// these lengths, 1 for people of usual size. Warns of what is left out where an Interruptible ends it.
Result<std::vector<ChartCut>> find_wall_cuts(const Accel& accel, float scale, Context& context);

}  // namespace oriel
