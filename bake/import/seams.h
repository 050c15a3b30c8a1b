// Seams that rounding left open.
#pragma once

#include "bake/scene/scene.h"

namespace oriel {

// Exporters and generators write a vertex once for each side of a seam, and some compute it twice: at 0 and at 2π a
// circle's points differ by rounding. Vertices of a surface's open edges that are nearer than a millionth of its size,
// or than rounding of their coordinates, get the position of the first of them: what is closed is found closed, charts
// and normals go on. No triangle loses half of its area or turns over; where one would, its corners stay.
void join_seams(Scene& scene);

}  // namespace oriel
